#pragma once

#include <cstddef>
#include <limits>
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
/// Within structures and sequences, strings stand in quotation marks with \" \\ \n \t \r as in C++.
/// Numbers take the shortest form that reads back to the same value.
///
/// `value` points to an object of the type. Threads: as for that object. Allocates.

/// How much of a value a person wants to see: "[1, 2, 3, … 640 in all]". What is not shown takes neither time
/// nor memory, however large the value is.
struct TextLimits {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::size_t elements = kNone;  ///< of a list; what comes after is only counted
  std::size_t text = kNone;      ///< bytes of a text
  std::size_t all = kNone;       ///< bytes of the whole; about
};

/// Opaque parts read "?".
[[nodiscard]] std::string ToText(const TypeInfo& type, const void* value, const TextLimits& limits = {});

/// Sets what the text names; elements of lists begin as their type makes them. Errors: say what is wrong,
/// and where in the text or of which field ("points[2].x"); the value may then be half set, so work on a copy.
Result<void> SetFromText(const TypeInfo& type, std::string_view text, void* value);

}  // namespace runnel
