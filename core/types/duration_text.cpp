#include "core/types/duration_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace runnel {

namespace {

struct Unit {
  std::string_view name;
  std::int64_t nanoseconds;
};
constexpr std::array<Unit, 5> kUnits{
    {{"min", 60'000'000'000}, {"s", 1'000'000'000}, {"ms", 1'000'000}, {"us", 1'000}, {"ns", 1}}};

// Seconds in the text rather than minutes: 90s reads better than 1.5min.
constexpr std::size_t kLargestWritten = 1;

std::string Fraction(std::uint64_t rest, std::uint64_t of) {
  std::string digits;
  while (rest != 0) {
    of /= 10;
    digits += static_cast<char>('0' + rest / of);
    rest %= of;
  }
  return digits.empty() ? "" : "." + digits;
}

}  // namespace

std::string DurationText(Duration duration) {
  const std::int64_t count = duration.count();
  // Through unsigned numbers, in which the most negative duration has a positive twin.
  const std::uint64_t size = count < 0 ? 0 - static_cast<std::uint64_t>(count) : static_cast<std::uint64_t>(count);
  if (size == 0) return "0s";
  std::size_t unit = kLargestWritten;
  while (size < static_cast<std::uint64_t>(kUnits[unit].nanoseconds)) ++unit;
  const auto scale = static_cast<std::uint64_t>(kUnits[unit].nanoseconds);
  return (count < 0 ? "-" : "") + std::to_string(size / scale) + Fraction(size % scale, scale) +
         std::string(kUnits[unit].name);
}

Result<Duration> ParseDuration(std::string_view text) {
  const Error refusal{.message = "'" + std::string(text) + "' is no duration",
                      .hint = "write a number and a unit: ns, us, ms, s or min, as in 20ms"};
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec != std::errc() || !std::isfinite(number)) return refusal;
  std::string_view unit = digits.substr(static_cast<std::size_t>(read.ptr - digits.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const Unit& each : kUnits) {
    if (unit != each.name) continue;
    const double nanoseconds = number * static_cast<double>(each.nanoseconds);
    if (std::abs(nanoseconds) > 9.2e18) return refusal;
    return Duration(std::llround(nanoseconds));
  }
  return refusal;
}

}  // namespace runnel
