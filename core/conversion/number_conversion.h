#pragma once

#include <optional>
#include <string_view>

#include "core/base/unit.h"
#include "core/conversion/conversion.h"

namespace runnel::internal {

/// Whether values of the type are numbers (bool: 0 and 1).
[[nodiscard]] bool IsNumber(const TypeInfo& type);

/// Whether each value of `from` is one of `to`. Precondition: both are numbers.
[[nodiscard]] bool NothingIsLost(const TypeInfo& from, const TypeInfo& to);

/// The number that `value` is, and the other way round. Precondition: the type is a number.
[[nodiscard]] double NumberIn(const TypeInfo& type, const void* value);
void SetNumber(const TypeInfo& type, void* value, double number);

enum class Rounding { kNone, kNearest, kTruncate };
/// "round", "truncate".
[[nodiscard]] std::optional<Rounding> RoundingCalled(std::string_view name);

/// From number to number, times `ratio`; what does not fit becomes the nearest that does, and what is no number
/// (NaN) becomes no whole number. Precondition: both are numbers.
[[nodiscard]] Conversion::Convert NumberConversion(const TypeInfo& from, const TypeInfo& to, Rounding rounding,
                                                   UnitRatio ratio);

}  // namespace runnel::internal
