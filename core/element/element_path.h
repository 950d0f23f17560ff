#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// Whether `name` can name an element, wherever it comes from: a file, a change at run time, a page,
/// C++ code. The rule is such that paths and lists of paths can be read again, and that every file can
/// carry every name: UTF-8 without control characters, not empty, no '/', no comma, no space,
/// tabulator or line end, not "." or "..". All else is good: letters of any language, '?', '"', '&'.
/// The error says what it breaks.
Result<void> CheckElementName(std::string_view name);

/// The names in a path: "robot/guard" and "/robot//guard/" both give {"robot", "guard"}. Whether it
/// began at the root is for the caller to look at.
[[nodiscard]] std::vector<std::string_view> SplitPath(std::string_view path);

/// Whether the element at `path` is that at `subtree` or lies below it; "" and "/" are the root.
[[nodiscard]] inline bool IsAtOrBelow(std::string_view path, std::string_view subtree) {
  while (subtree.ends_with('/')) subtree.remove_suffix(1);
  return path.starts_with(subtree) && (path.size() == subtree.size() || path[subtree.size()] == '/');
}

/// What is at or below `from` is at or below `to` now. Other paths stay.
inline void MovePath(std::string& path, std::string_view from, std::string_view to) {
  if (IsAtOrBelow(path, from)) path.replace(0, from.size(), to);
}

[[nodiscard]] inline bool IsAbsolutePath(std::string_view path) { return !path.empty() && path.front() == '/'; }

}  // namespace runnel
