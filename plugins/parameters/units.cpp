#include "plugins/parameters/units.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/base/characters.h"
#include "core/base/unit.h"

namespace runnel {

namespace {

std::string NumberText(double number) {
  std::array<char, 400> digits{};  // the largest number has 309
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
  return {digits.data(), end.ptr};
}

}  // namespace

Result<std::string> NumberInUnit(std::string_view text, std::string_view unit) {
  const std::string_view all = Trimmed(text);
  const std::string_view digits = all.substr(all.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const std::string_view own =
      Trimmed(digits.substr(static_cast<std::size_t>(read.ptr - digits.data())));
  if (read.ec != std::errc() || !std::isfinite(number) || own.empty()) return std::string(text);
  if (own == unit)
    return std::string(digits.substr(0, static_cast<std::size_t>(read.ptr - digits.data())));
  const std::string quoted = "'" + std::string(all) + "'";
  const auto from = ParseUnit(own);
  if (unit.empty()) {
    if (!from) return std::string(text);
    return Error{.message = quoted + " has a unit where none is wanted",
                 .hint = "write the number only"};
  }
  const std::string hint = "write it in " + std::string(unit);
  if (!from) return Error{.message = quoted + " is no number with a unit", .hint = hint};
  const auto ratio = RatioOfUnits(own, unit);
  if (!ratio) {
    return Error{.message = quoted + " is no value in " + std::string(unit), .hint = hint};
  }
  return NumberText(number * ratio->numerator / ratio->denominator);
}

}  // namespace runnel
