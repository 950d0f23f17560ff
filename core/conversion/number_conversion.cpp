#include "core/conversion/number_conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/types/type_of.h"

namespace runnel::internal {

namespace {

// Has all bits that any of the types has.
using Number = long double;
static_assert(std::numeric_limits<Number>::digits >= 64);

struct NumberType {
  const TypeInfo* type;
  int digits;
  bool is_signed;
  bool is_whole;
  Number (*get)(const void* value);
  bool (*set)(void* value, Number number, Rounding rounding);
};

template <typename N>
bool Set(void* at, Number number, Rounding rounding) {
  if constexpr (std::is_integral_v<N>) {
    if (std::isnan(number)) return false;
    number = rounding == Rounding::kNearest ? std::round(number) : std::trunc(number);
  } else if (std::isnan(number)) {
    *static_cast<N*>(at) = std::numeric_limits<N>::quiet_NaN();
    return true;
  }
  if (std::is_integral_v<N> || rounding != Rounding::kNone) {
    const bool is_endless = !std::is_integral_v<N> && std::isinf(number);
    if (!is_endless) {
      number = std::clamp(number, static_cast<Number>(std::numeric_limits<N>::lowest()),
                          static_cast<Number>(std::numeric_limits<N>::max()));
    }
  }
  *static_cast<N*>(at) = static_cast<N>(number);
  return true;
}

template <typename N>
NumberType Entry() {
  return {&TypeOf<N>(),
          std::numeric_limits<N>::digits,
          std::is_signed_v<N>,
          std::is_integral_v<N>,
          [](const void* at) { return static_cast<Number>(*static_cast<const N*>(at)); },
          Set<N>};
}

const NumberType* FindNumberType(const TypeInfo& type) {
  static const std::array<NumberType, 11> types{Entry<bool>(),          Entry<std::int8_t>(),   Entry<std::int16_t>(),
                                                Entry<std::int32_t>(),  Entry<std::int64_t>(),  Entry<std::uint8_t>(),
                                                Entry<std::uint16_t>(), Entry<std::uint32_t>(), Entry<std::uint64_t>(),
                                                Entry<float>(),         Entry<double>()};
  const auto found = std::ranges::find(types, &type, &NumberType::type);
  return found == types.end() ? nullptr : &*found;
}

}  // namespace

bool IsNumber(const TypeInfo& type) { return FindNumberType(type) != nullptr; }

double NumberIn(const TypeInfo& type, const void* value) {
  return static_cast<double>(FindNumberType(type)->get(value));
}

void SetNumber(const TypeInfo& type, void* value, double number) {
  (void)FindNumberType(type)->set(value, number, Rounding::kNearest);
}

bool NothingIsLost(const TypeInfo& from_type, const TypeInfo& to_type) {
  const NumberType& from = *FindNumberType(from_type);
  const NumberType& to = *FindNumberType(to_type);
  if (&from == &to) return true;
  if (to.is_whole && (!from.is_whole || (from.is_signed && !to.is_signed))) return false;
  return from.digits <= to.digits;
}

std::optional<Rounding> RoundingCalled(std::string_view name) {
  if (name == "round") return Rounding::kNearest;
  if (name == "truncate") return Rounding::kTruncate;
  return std::nullopt;
}

Conversion::Convert NumberConversion(const TypeInfo& from, const TypeInfo& to, Rounding rounding, UnitRatio ratio) {
  return [get = FindNumberType(from)->get, set = FindNumberType(to)->set, rounding, ratio](const void* value,
                                                                                           void* result) {
    // In doubles, as a person would: 180 * pi / 180 is pi.
    if (ratio.numerator != ratio.denominator) {
      const double number = static_cast<double>(get(value)) * ratio.numerator / ratio.denominator;
      return set(result, number, rounding);
    }
    return set(result, get(value), rounding);
  };
}

}  // namespace runnel::internal
