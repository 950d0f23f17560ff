#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

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

}  // namespace runnel
