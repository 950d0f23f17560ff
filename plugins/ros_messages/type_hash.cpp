#include <array>
#include <string>
#include <string_view>

#include <fmt/ranges.h>
#include <openssl/sha.h>

#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

// As 64 hexadecimal digits.
std::string Sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

// With the spaces of Python's json.dumps(), since it is this text of which ROS 2 takes the hash.
std::string DescriptionOf(const MessageField& field) {
  constexpr int kArray = 48, kBounded = 96, kList = 144, kToBoundedString = 4;
  int id = static_cast<int>(field.type);
  if (field.text_capacity > 0) id += kToBoundedString;
  if (field.count == MessageCount::kArray) id += kArray;
  if (field.count == MessageCount::kBounded) id += kBounded;
  if (field.count == MessageCount::kList) id += kList;
  return R"({"name": ")" + field.name + R"(", "type": {"type_id": )" + std::to_string(id) +
         R"(, "capacity": )" + std::to_string(field.capacity) + R"(, "string_capacity": )" +
         std::to_string(field.text_capacity) + R"(, "nested_type_name": ")" + field.nested +
         R"("}})";
}

std::string DescriptionOf(const MessageDefinition& definition) {
  std::string text = R"({"type_name": ")" + definition.name + R"(", "fields": [)";
  static const MessageField kInstead{.name = "structure_needs_at_least_one_member",
                                     .type = MessageType::kUint8};
  if (definition.fields.empty()) text += DescriptionOf(kInstead);
  for (const MessageField& field : definition.fields) {
    if (&field != &definition.fields.front()) text += ", ";
    text += DescriptionOf(field);
  }
  return text + "]}";
}

}  // namespace

std::string TypeHashOf(const MessageDefinition& definition, const MessageLibrary& library) {
  std::string text = R"({"type_description": )" + DescriptionOf(definition) +
                     R"(, "referenced_type_descriptions": [)";
  std::string between;
  for (const MessageDefinition* const each : library.InsideOf(definition)) {
    text += between + DescriptionOf(*each);
    between = ", ";
  }
  return "RIHS01_" + Sha256(text + "]}");
}

}  // namespace runnel
