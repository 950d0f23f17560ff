#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// How much a message matters, the least first.
enum class LogLevel : std::uint8_t { kDebug, kInfo, kWarning, kError, kOff };

/// "debug", "info", "warning", "error", "off", in the order of the levels. The last is no message's: where it
/// is asked for, nothing is logged.
[[nodiscard]] const std::array<std::string, 5>& LogLevelNames();
[[nodiscard]] const std::string& LogLevelName(LogLevel level);
/// The error names what comes nearest.
[[nodiscard]] Result<LogLevel> LogLevelOf(std::string_view name);

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
