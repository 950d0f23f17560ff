#pragma once

#include <bit>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/types/builtin_types.h"
#include "core/types/leaf_types.h"
#include "core/types/type_info.h"
#include "plugins/ros_messages/message_definition.h"

namespace runnel::internal {

inline constexpr std::string_view kHeaderMessage = "std_msgs/msg/Header";
inline constexpr std::string_view kTimeMessage = "builtin_interfaces/msg/Time";
inline constexpr std::string_view kDurationMessage = "builtin_interfaces/msg/Duration";

/// kInt8 to kUint64 are in the order of their sizes, each signed one before its unsigned one.
inline MessageType IntegerType(std::size_t size, bool is_signed) {
  const int place = 2 * std::countr_zero(size) + (is_signed ? 0 : 1);
  return static_cast<MessageType>(static_cast<int>(MessageType::kInt8) + place);
}

/// What a leaf or an enumeration is in a message; kNested with the message's name for durations, times and signals.
inline MessageField FieldOfLeaf(const TypeInfo& type) {
  if (type.kind() == TypeKind::kEnumeration) {
    bool is_signed = false;
    for (const EnumeratorInfo& each : type.enumerators()) is_signed |= each.value < 0;
    return {.name = {}, .type = IntegerType(type.size(), is_signed)};
  }
  if (&type == &TypeOf<Signal>()) {
    return {.name = {}, .type = MessageType::kNested, .nested = "std_msgs/msg/Empty"};
  }
  return WithLeafType(type, []<typename T>(std::type_identity<T>) -> MessageField {
    const auto nested = [](std::string_view name) {
      return MessageField{.name = {}, .type = MessageType::kNested, .nested = std::string(name)};
    };
    const auto number = [](MessageType as) { return MessageField{.name = {}, .type = as}; };
    if constexpr (std::is_same_v<T, Duration>) return nested(kDurationMessage);
    if constexpr (std::is_same_v<T, Time>) return nested(kTimeMessage);
    if constexpr (std::is_same_v<T, bool>) return number(MessageType::kBool);
    if constexpr (std::is_same_v<T, float>) return number(MessageType::kFloat32);
    if constexpr (std::is_same_v<T, double>) return number(MessageType::kFloat64);
    if constexpr (std::is_integral_v<T>) return number(IntegerType(sizeof(T), std::is_signed_v<T>));
    return number(MessageType::kString);
  });
}

[[nodiscard]] inline bool IsLeaf(const TypeInfo& type) {
  return type.kind() == TypeKind::kLeaf || type.kind() == TypeKind::kEnumeration;
}
[[nodiscard]] inline bool IsElements(const TypeInfo& type) {
  return type.kind() == TypeKind::kSequence || type.kind() == TypeKind::kMatrix;
}

/// How many elements each value of a fixed array has; 0 if the type cannot make any value to look at.
[[nodiscard]] inline std::size_t FixedCount(const TypeInfo& type) {
  const auto value = type.Make();
  if (value == nullptr) return 0;
  return type.elements().rows(value.get()) * type.elements().columns(value.get());
}

}  // namespace runnel::internal
