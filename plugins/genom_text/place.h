#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"

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
  int FileIndex(const std::string& name) {
    const auto found = std::ranges::find(files_, name);
    if (found != files_.end()) return static_cast<int>(found - files_.begin());
    files_.push_back(name);
    return static_cast<int>(files_.size()) - 1;
  }
  [[nodiscard]] const std::string& FileName(int index) const { return files_.at(static_cast<std::size_t>(index)); }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
  [[nodiscard]] SourcePosition PositionOf(Place place) const {
    return place.file < 0 ? SourcePosition{} : SourcePosition{FileName(place.file), place.line, place.column};
  }

  void Add(Place place, std::string message, std::string hint = {}) {
    if (++count_ > kMost) return;
    diagnostics_.Add({.message = std::move(message), .position = PositionOf(place), .hint = std::move(hint)});
  }
  void Warn(Place place, std::string message, std::string hint = {}) {
    if (diagnostics_.warnings().size() >= kMost) return;
    diagnostics_.AddWarning({.message = std::move(message), .position = PositionOf(place), .hint = std::move(hint)});
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// "declared in file:3:5", for hints.
  [[nodiscard]] std::string DeclaredAt(Place place) const {
    if (place.file < 0) return "it is declared by the language";
    return "it is declared in " + FileName(place.file) + ":" + std::to_string(place.line) + ":" +
           std::to_string(place.column);
  }

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
