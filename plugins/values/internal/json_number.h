#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/number_text.h"
#include "core/types/value_tokens.h"

namespace runnel::internal {

[[nodiscard]] inline bool IsNumber(const ValueToken& token) {
  return token.kind == ValueToken::Kind::kWord && token.text.find_first_of("0123456789") != std::string::npos;
}

/// Nothing if the token is no number, or one that does not fit: not finite in `N`, though a double could say it; or
/// no whole number, or out of range. What is beyond the largest double is infinity, as all parsers of JSON have
/// it; what is nearer to 0 than the smallest is 0.
template <typename N>
[[nodiscard]] std::optional<N> NumberOf(const ValueToken& token) {
  if (!IsNumber(token)) return std::nullopt;
  if (const auto number = NumberIn<N>(token.text)) return number;
  // So large or small that only this has room for it; or 3.0 and 1e3, which are whole numbers, too.
  const auto wide = NumberIn<long double>(token.text).value_or(0);
  if constexpr (std::floating_point<N>) {
    const bool is_too_large =
        std::abs(wide) <= std::numeric_limits<double>::max() && std::abs(wide) > std::numeric_limits<N>::max();
    return is_too_large ? std::nullopt : std::optional(static_cast<N>(wide));
  } else {
    constexpr long double kSurelyWhole = 9007199254740992;  // so far as a double can tell
    if (std::abs(wide) > kSurelyWhole || wide != std::trunc(wide)) return std::nullopt;
    const auto whole = static_cast<std::int64_t>(wide);
    return std::in_range<N>(whole) ? std::optional(static_cast<N>(whole)) : std::nullopt;
  }
}

}  // namespace runnel::internal
