#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/types/leaf_types.h"
#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/ros_messages/message_definition.h"

namespace runnel::internal {

/// Numbers of any type on their way into one of another type. A long double holds each of them exactly.
using AnyNumber = long double;

template <typename Use>
auto WithMessageNumber(MessageType type, const Use& use) {
  switch (type) {
    case MessageType::kInt8:
      return use(std::type_identity<std::int8_t>());
    case MessageType::kInt16:
      return use(std::type_identity<std::int16_t>());
    case MessageType::kUint16:
      return use(std::type_identity<std::uint16_t>());
    case MessageType::kInt32:
      return use(std::type_identity<std::int32_t>());
    case MessageType::kUint32:
      return use(std::type_identity<std::uint32_t>());
    case MessageType::kInt64:
      return use(std::type_identity<std::int64_t>());
    case MessageType::kUint64:
      return use(std::type_identity<std::uint64_t>());
    case MessageType::kFloat32:
      return use(std::type_identity<float>());
    case MessageType::kFloat64:
      return use(std::type_identity<double>());
    case MessageType::kBool:
      return use(std::type_identity<bool>());
    default:
      return use(std::type_identity<std::uint8_t>());
  }
}

/// The nearest value of N; false if the number does not fit, and is held at the limit.
template <typename N>
bool Convert(AnyNumber number, N& converted) {
  if constexpr (std::is_same_v<N, bool>) {
    converted = number != 0;
  } else if constexpr (std::is_integral_v<N>) {
    constexpr std::numeric_limits<N> kLimits;
    number = std::nearbyint(number);
    const bool is_low = !(number >= static_cast<AnyNumber>(kLimits.min()));  // nothing is no number
    if (is_low || number > static_cast<AnyNumber>(kLimits.max())) {
      converted = is_low ? kLimits.min() : kLimits.max();
      return false;
    }
    converted = static_cast<N>(number);
  } else {
    converted = static_cast<N>(number);
  }
  return true;
}

inline AnyNumber NumberOf(const TypeInfo& type, const void* value) {
  if (type.kind() == TypeKind::kEnumeration) return static_cast<AnyNumber>(type.enumeration().get(value));
  return WithLeafType(type, [&]<typename T>(std::type_identity<T>) -> AnyNumber {
    if constexpr (std::is_arithmetic_v<T>) return static_cast<AnyNumber>(*static_cast<const T*>(value));
    return 0;
  });
}

/// False if it does not fit, or is no value of the enumeration; the value then stays.
inline bool SetNumber(const TypeInfo& type, AnyNumber number, void* value) {
  if (type.kind() == TypeKind::kEnumeration) {
    for (const EnumeratorInfo& each : type.enumerators()) {
      if (static_cast<AnyNumber>(each.value) != number) continue;
      type.enumeration().set(value, each.value);
      return true;
    }
    return false;
  }
  return WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_arithmetic_v<T>) {
      T converted{};
      if (!Convert(number, converted)) return false;
      *static_cast<T*>(value) = converted;
      return true;
    }
    return false;
  });
}

inline void PutNumber(MessageType type, AnyNumber number, CdrWriter& writer) {
  WithMessageNumber(type, [&]<typename N>(std::type_identity<N>) {
    N converted{};
    Convert(number, converted);
    writer.Put(converted);
  });
}

[[nodiscard]] inline bool GetNumber(MessageType type, CdrReader& reader, AnyNumber& number) {
  return WithMessageNumber(type, [&]<typename N>(std::type_identity<N>) {
    N read{};
    if (!reader.Get(read)) return false;
    number = static_cast<AnyNumber>(read);
    return true;
  });
}

}  // namespace runnel::internal
