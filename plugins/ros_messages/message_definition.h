#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// What one element of a field is; the numbers are those of ROS 2's type descriptions.
enum class MessageType : std::uint8_t {
  kNested = 1,
  kInt8 = 2,
  kUint8 = 3,  ///< char, too
  kInt16 = 4,
  kUint16 = 5,
  kInt32 = 6,
  kUint32 = 7,
  kInt64 = 8,
  kUint64 = 9,
  kFloat32 = 10,
  kFloat64 = 11,
  kBool = 15,
  kByte = 16,
  kString = 17,
  kWideString = 18,
};

enum class MessageCount : std::uint8_t {
  kOne,
  kArray,    ///< T[n]
  kBounded,  ///< T[<=n]
  kList,     ///< T[]
};

struct MessageField {
  std::string name;
  MessageType type = MessageType::kInt8;
  std::string nested = {};  ///< "geometry_msgs/msg/Point", of kNested
  MessageCount count = MessageCount::kOne;
  std::size_t capacity = 0;        ///< n of an array or a bounded list
  std::size_t text_capacity = 0;   ///< of string<=n, 0 for any
  std::string default_value = {};  ///< as it stands in the file: 1.0, "a", [1, 2]; "" for none
  std::string comment = {};        ///< written behind the field

  friend bool operator==(const MessageField&, const MessageField&) = default;
};

/// A value with a name: on no wire.
struct MessageConstant {
  std::string type;
  std::string name;
  std::string value;

  friend bool operator==(const MessageConstant&, const MessageConstant&) = default;
};

/// A message of ROS 2: "sensor_msgs/msg/LaserScan" and its fields in order.
struct MessageDefinition {
  std::string name;
  std::vector<MessageField> fields = {};
  std::vector<MessageConstant> constants = {};

  [[nodiscard]] const MessageField* FindField(std::string_view field) const;

  friend bool operator==(const MessageDefinition&, const MessageDefinition&) = default;
};

/// "uint8" for kUint8; "" for a nested one.
[[nodiscard]] std::string_view NameOf(MessageType type);
/// How many octets a number has on the wire; 0 for nested ones and strings.
[[nodiscard]] std::size_t SizeOf(MessageType type);
/// The number or text of that name in .msg files; nothing if it is none.
[[nodiscard]] std::optional<MessageType> FindMessageType(std::string_view name);
[[nodiscard]] std::vector<std::string> MessageTypeNames();

/// Reads the text of a .msg file. `name`: of the message. Whether nested messages exist is not looked at.
/// Errors: what is wrong with which line of `file`, and the cure.
[[nodiscard]] Result<MessageDefinition> ParseMessage(std::string_view text, const std::string& name,
                                                     const std::string& file);

/// The text of a .msg file. Nested messages of the same package stand without it.
[[nodiscard]] std::string TextOf(const MessageDefinition& definition);

}  // namespace runnel
