#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostics.h"

namespace runnel::genom {

/// Where something stands in the files of a description; small, since each token has one.
struct Place {
  int file = -1;  ///< index into the names of Problems; -1: nowhere
  int line = 0;
  int column = 0;
};

/// Collects what is wrong with a description, and knows the names of its files.
///
/// Of a description with thousands of mistakes the first ones are told.
///
/// Threads: not thread-safe.
class Problems {
 public:
  static constexpr std::size_t kMost = 200;

  explicit Problems(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// The index of a file's name, made if it is new.
  int FileIndex(const std::string& name);
  [[nodiscard]] const std::string& FileName(int index) const { return files_.at(static_cast<std::size_t>(index)); }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
  [[nodiscard]] SourcePosition PositionOf(Place place) const;

  void Add(Place place, std::string message, std::string hint = {});
  void Warn(Place place, std::string message, std::string hint = {});
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// "declared in file:3:5", for hints.
  [[nodiscard]] std::string DeclaredAt(Place place) const;

 private:
  Diagnostics& diagnostics_;
  std::vector<std::string> files_ = {};
  std::size_t count_ = 0;
};

/// A token as the preprocessor sees it: what words and numbers mean is not known yet.
struct TextToken {
  enum class Kind { kEnd, kNewline, kWord, kNumber, kString, kCharacter, kMark, kStray, kPragma };

  Kind kind = Kind::kEnd;
  std::string text = {};  ///< as written; of a pragma, the rest of its line
  Place place = {};
  bool has_space_before = false;
  bool is_fixed = false;  ///< the name of a macro within its own expansion: stays as it is

  [[nodiscard]] bool Is(Kind wanted, const char* what) const { return kind == wanted && text == what; }
  [[nodiscard]] bool IsMark(const char* what) const { return Is(Kind::kMark, what); }
};

}  // namespace runnel::genom
