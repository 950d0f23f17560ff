#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "core/types/leaf_types.h"
#include "core/types/signal.h"
#include "core/types/type_info.h"
#include "plugins/ros_messages/message_definition.h"

namespace runnel::internal {

inline constexpr std::string_view kHeaderMessage = "std_msgs/msg/Header";
inline constexpr std::string_view kTimeMessage = "builtin_interfaces/msg/Time";
inline constexpr std::string_view kDurationMessage = "builtin_interfaces/msg/Duration";

/// What a leaf or an enumeration is in a message; kNested with the message's name for durations, times and signals.
inline MessageField FieldOfLeaf(const TypeInfo& type) {
  if (type.kind() == TypeKind::kEnumeration) {
    bool is_signed = false;
    for (const EnumeratorInfo& each : type.enumerators()) is_signed |= each.value < 0;
    const MessageType types[] = {MessageType::kUint8, MessageType::kUint16, MessageType::kUint32,
                                 MessageType::kUint64};
    const MessageType signed_types[] = {MessageType::kInt8, MessageType::kInt16, MessageType::kInt32,
                                        MessageType::kInt64};
    const int size = type.size() == 1 ? 0 : type.size() == 2 ? 1 : type.size() == 4 ? 2 : 3;
    return {.name = {}, .type = is_signed ? signed_types[size] : types[size]};
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
    if constexpr (std::is_same_v<T, std::int8_t>) return number(MessageType::kInt8);
    if constexpr (std::is_same_v<T, std::uint8_t>) return number(MessageType::kUint8);
    if constexpr (std::is_same_v<T, std::int16_t>) return number(MessageType::kInt16);
    if constexpr (std::is_same_v<T, std::uint16_t>) return number(MessageType::kUint16);
    if constexpr (std::is_same_v<T, std::int32_t>) return number(MessageType::kInt32);
    if constexpr (std::is_same_v<T, std::uint32_t>) return number(MessageType::kUint32);
    if constexpr (std::is_same_v<T, std::int64_t>) return number(MessageType::kInt64);
    if constexpr (std::is_same_v<T, std::uint64_t>) return number(MessageType::kUint64);
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
