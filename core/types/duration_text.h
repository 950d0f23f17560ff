#pragma once

#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// "20ms", "1.5s", "0s": in the largest unit of ns, us, ms, s and min in which it is at least 1,
/// exact to the nanosecond.
[[nodiscard]] std::string DurationText(Duration duration);

/// A decimal number and a unit (ns, us, ms, s, min), with or without a space between; negative ones
/// too. Rounded to the nearest nanosecond.
[[nodiscard]] Result<Duration> ParseDuration(std::string_view text);

}  // namespace runnel
