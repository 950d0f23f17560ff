#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace runnel {

/// The number that the whole of `text` is, with '.' as the decimal point; nothing if it is none, or does not fit.
template <typename Number>
[[nodiscard]] std::optional<Number> NumberIn(std::string_view text) noexcept {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return number;
}

}  // namespace runnel
