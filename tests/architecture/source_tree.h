#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace runnel::test {

/// The texts of a source tree by their paths from its root. Tests of the rules make small ones.
using SourceTree = std::map<std::string, std::string>;

/// Reads the files below the source folders of `root`, and those in `root` itself: those that git
/// tracks, for what else lies there (a log, a build) is nobody's source; all where git knows none, as
/// in an unpacked archive.
[[nodiscard]] SourceTree ReadSourceTree(const std::filesystem::path& root);

[[nodiscard]] bool IsCode(std::string_view file);
/// "core/port" for "core/port/input.h", "" for "README.md".
[[nodiscard]] std::string FolderOf(std::string_view file);
/// The first two names of the path, "core/port" for "core/port/deep/file.h": what one
/// CMakeLists.txt makes one library of. "" if the file does not lie that deep.
[[nodiscard]] std::string LibraryOf(std::string_view file);
[[nodiscard]] bool IsAtOrBelow(std::string_view file, std::string_view folder);
[[nodiscard]] std::vector<std::string_view> Lines(std::string_view text);

}  // namespace runnel::test
