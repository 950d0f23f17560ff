#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace runnel {

/// Of digits that JsonCursor::TakeNumber() gave. What is beyond the largest double is infinity, as
/// all parsers of JSON have it; what is nearer to 0 than the smallest is 0.
[[nodiscard]] double DoubleOf(std::string_view digits);

/// Nothing if it does not fit: not finite in `N`, though a double could say it; or no whole number,
/// or out of range.
template <std::floating_point N>
[[nodiscard]] std::optional<N> NumberOf(std::string_view digits) {
  if (digits.empty()) return std::nullopt;
  N number{};
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec == std::errc()) return number;
  const double wide = DoubleOf(digits);
  const bool is_too_large = std::isfinite(wide) && std::abs(wide) > std::numeric_limits<N>::max();
  return is_too_large ? std::nullopt : std::optional<N>(static_cast<N>(wide));
}

template <std::integral N>
[[nodiscard]] std::optional<N> NumberOf(std::string_view digits) {
  if (digits.empty()) return std::nullopt;
  N number{};
  const auto end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  if (read.ec == std::errc() && read.ptr == end) return number;
  if (read.ec == std::errc::result_out_of_range) return std::nullopt;
  // 3.0 and 1e3 are whole numbers, too; so far as a double can tell.
  constexpr double kSurelyWhole = 9007199254740992.0;
  const double wide = DoubleOf(digits);
  if (!(std::abs(wide) <= kSurelyWhole) || wide != std::trunc(wide)) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(wide);
  if (!std::in_range<N>(whole)) return std::nullopt;
  return static_cast<N>(whole);
}

}  // namespace runnel
