#pragma once

#include <string>

namespace runnel::genom {

struct Merged {
  std::string text = {};
  int conflicts = 0;  ///< where both changed the same lines, both stand in the text between marks
};

/// What becomes of a text that was made as `base`, that its user changed to `mine`, and that is made anew as `made`: the
/// changes of both, line by line. O(lines²) in time and memory.
[[nodiscard]] Merged Merge(const std::string& base, const std::string& mine, const std::string& made);

}  // namespace runnel::genom
