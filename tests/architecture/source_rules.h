#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace runnel::test {

/// Libraries whose code and headers together reach `limit` lines: "core/port: 5012 lines".
[[nodiscard]] std::vector<std::string> TooLargeLibraries(const SourceTree& tree, std::size_t limit);

/// Files of code that go beyond `limit` lines: "core/port/input.h: 351 lines".
[[nodiscard]] std::vector<std::string> TooLongFiles(const SourceTree& tree, std::size_t limit);

/// Files in the root of the tree that are none of those that belong there.
[[nodiscard]] std::vector<std::string> StrayFiles(const SourceTree& tree);

/// Libraries (folders like core/port; not tests and bench) that have sources and no README.md.
[[nodiscard]] std::vector<std::string> LibrariesWithoutReadme(const SourceTree& tree);

/// Places of text that belongs to somebody's machine or to an unfinished state, as
/// "file:line: what": absolute paths of home and work folders, marks of things to be done, and in
/// documents the marks of something that was to be filled in.
[[nodiscard]] std::vector<std::string> ForbiddenText(const SourceTree& tree);

/// Headers that do not begin with #pragma once.
[[nodiscard]] std::vector<std::string> HeadersWithoutGuard(const SourceTree& tree);

}  // namespace runnel::test
