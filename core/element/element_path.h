#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// Whether `name` can name an element: not empty, no '/', no white space or control characters at
/// its ends or of other kinds than the blank, not "." or "..". The error says which rule it breaks.
Result<void> CheckElementName(std::string_view name);

/// The names in a path: "robot/guard" and "/robot//guard/" both give {"robot", "guard"}. Whether it
/// began at the root is for the caller to look at.
[[nodiscard]] std::vector<std::string_view> SplitPath(std::string_view path);

[[nodiscard]] inline bool IsAbsolutePath(std::string_view path) {
  return !path.empty() && path.front() == '/';
}

}  // namespace runnel
