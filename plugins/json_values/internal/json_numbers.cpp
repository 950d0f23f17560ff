#include "plugins/json_values/internal/json_numbers.h"

#include <algorithm>

namespace runnel {

namespace {

// Of digits that no double can say: whether they are huge, not tiny. That is for the exponent to
// tell, and for where the first digit other than 0 stands.
bool IsHuge(std::string_view digits) {
  if (digits.starts_with('-')) digits.remove_prefix(1);
  const auto mark = std::min(digits.find_first_of("eE"), digits.size());
  const std::string_view mantissa = digits.substr(0, mark);
  const std::string_view exponent = mark < digits.size() ? digits.substr(mark + 1) : "0";
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  const auto first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  const std::string_view exponent_digits =
      exponent.starts_with('+') ? exponent.substr(1) : exponent;
  std::int64_t power = 0;
  const auto read = std::from_chars(exponent_digits.data(),
                                    exponent_digits.data() + exponent_digits.size(), power);
  if (read.ec == std::errc::result_out_of_range) return !exponent.starts_with('-');
  // Saturating: a text has never so many digits that they could outweigh such a power.
  constexpr std::int64_t kFar = std::int64_t{1} << 60;
  return std::clamp(power, -kFar, kFar) + point - static_cast<std::int64_t>(first) > 0;
}

}  // namespace

double DoubleOf(std::string_view digits) {
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec == std::errc()) return number;
  const double size = IsHuge(digits) ? std::numeric_limits<double>::infinity() : 0.0;
  return digits.starts_with('-') ? -size : size;
}

}  // namespace runnel
