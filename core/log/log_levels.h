#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/log/log_level.h"

namespace runnel {

class Runtime;

/// Of a subtree, by the full path of its root ("" is everything), what is logged at least.
using LogLevels = std::vector<std::pair<std::string, LogLevel>>;

/// From now on elements at and below `path` log what is at least of this level, those too that are made later; of
/// several paths the longest counts. Without any, `info` and more. What is set of an element is kept with it: it goes with
/// it, and to what stands for it (another name, a replacement, an undo). Locks and allocates; any thread.
void SetLogLevel(Runtime& runtime, std::string path, LogLevel level);
/// What has been set, in the order of the paths.
[[nodiscard]] LogLevels ReadLogLevels(Runtime& runtime);
/// Ends what was set for this very path; false if nothing was.
bool ResetLogLevel(Runtime& runtime, const std::string& path);

}  // namespace runnel
