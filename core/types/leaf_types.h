#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "core/base/clock.h"
#include "core/types/type_of.h"

namespace runnel {

namespace internal {

template <typename T, typename... More, typename Use>
auto WithOneOf(const TypeInfo& type, const Use& use) {
  if (&type == &TypeOf<T>()) return use(std::type_identity<T>());
  if constexpr (sizeof...(More) > 0) {
    return WithOneOf<More...>(type, use);
  } else {
    return use(std::type_identity<void>());
  }
}

}  // namespace internal

/// Calls `use` with the C++ type of a leaf, as a std::type_identity, if it is one that everybody knows; with
/// void for one that has a text format of its own.
template <typename Use>
auto WithLeafType(const TypeInfo& type, const Use& use) {
  // What lists are made of comes first.
  return internal::WithOneOf<float, double, std::uint8_t, std::uint16_t, std::int32_t, std::uint32_t, bool, std::string,
                             std::int64_t, std::uint64_t, Duration, Time, std::int8_t, std::int16_t>(type, use);
}

}  // namespace runnel
