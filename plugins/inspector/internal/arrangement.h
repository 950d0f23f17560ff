#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/base/result.h"

namespace runnel::internal {

/// What viewers have arranged, in their own words: where boxes stand, notes on them. Texts by names, shared by
/// all viewers and kept in a file beside the application's. The application knows nothing of it.
///
/// Threads:  one, but for Write().
class Arrangement {
 public:
  using Entries = std::map<std::string, std::string>;
  static constexpr std::size_t kMostEntries = 20'000;
  static constexpr std::size_t kLongestName = 1'000;  ///< bytes
  static constexpr std::size_t kLongestText = 2'000;

  /// Where it is kept: "/x/robot.xml" has "/x/robot.layout.json"; "" has none.
  [[nodiscard]] static std::string FileOf(const std::string& application_file);

  /// Takes over what is in the file; a file that is not there is an empty one.
  /// Errors: it cannot be read; nothing has been taken over then.
  Result<void> Read(const std::string& file);

  /// An empty text takes the entry away. Errors: too long, too many; nothing has been changed then.
  Result<void> Change(const Entries& changed);

  /// Counts changes.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// What has become of the entries that were changed after `revision`: "" is gone. After 0: all there are.
  [[nodiscard]] Entries Since(std::uint64_t revision) const;
  /// The same as viewers are told it.
  [[nodiscard]] std::string MessageSince(std::uint64_t revision) const;

  /// As a file has it: an entry a line, in order of their names.
  [[nodiscard]] std::string Text() const;
  /// Any thread. Without text the file is taken away. Errors: of the file.
  static Result<void> Write(const std::string& file, const std::string& text);

 private:
  struct Entry {
    std::string text;  // "": taken away; viewers may not have been told yet
    std::uint64_t revision = 0;
  };
  std::map<std::string, Entry> entries_;
  std::uint64_t revision_ = 0;
};

}  // namespace runnel::internal
