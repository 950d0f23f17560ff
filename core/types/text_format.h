#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

class TypeInfo;

/// Values as text that a person can read and write:
///
///     leaf          true   -3   0.25   20ms   some words
///     enumeration   left
///     structure     {x: 1, y: 2}
///     sequence      [1, 2, 3]
///     matrix        [[1, 2], [3, 4]]
///
/// Within structures and sequences, strings stand in quotation marks with \" \\ \n \t as in C++.
/// Numbers take the shortest form that reads back to the same value.
///
/// `value` points to an object of the type. Threads: as for that object. Allocates.

/// Opaque parts read "?".
[[nodiscard]] std::string ToText(const TypeInfo& type, const void* value);

/// Sets what the text names. Errors: say what is wrong and where in the text; the value may then be
/// half set, so work on a copy.
Result<void> SetFromText(const TypeInfo& type, std::string_view text, void* value);

}  // namespace runnel
