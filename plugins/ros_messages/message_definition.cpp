#include "plugins/ros_messages/message_definition.h"

#include <algorithm>

#include "core/base/nearest_name.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

struct TypeName {
  MessageType type;
  std::string_view name;
  std::size_t size;
};

constexpr TypeName kTypes[] = {
    {MessageType::kInt8, "int8", 1},       {MessageType::kUint8, "uint8", 1},
    {MessageType::kInt16, "int16", 2},     {MessageType::kUint16, "uint16", 2},
    {MessageType::kInt32, "int32", 4},     {MessageType::kUint32, "uint32", 4},
    {MessageType::kInt64, "int64", 8},     {MessageType::kUint64, "uint64", 8},
    {MessageType::kFloat32, "float32", 4}, {MessageType::kFloat64, "float64", 8},
    {MessageType::kBool, "bool", 1},       {MessageType::kByte, "byte", 1},
    {MessageType::kString, "string", 0},   {MessageType::kWideString, "wstring", 0},
};

std::string TypeTextOf(const MessageField& field, std::string_view package) {
  std::string text(NameOf(field.type));
  if (field.type == MessageType::kNested) {
    const std::string own = PackageOf(field.nested);
    text = (own == package ? "" : own + "/") + LastNameOf(field.nested);
  }
  if (field.text_capacity > 0) text += "<=" + std::to_string(field.text_capacity);
  if (field.count == MessageCount::kOne) return text;
  if (field.count == MessageCount::kList) return text + "[]";
  return text + (field.count == MessageCount::kBounded ? "[<=" : "[") + std::to_string(field.capacity) + "]";
}

}  // namespace

const MessageField* MessageDefinition::FindField(std::string_view field) const {
  const auto found = std::ranges::find(fields, field, &MessageField::name);
  return found == fields.end() ? nullptr : &*found;
}

std::string_view NameOf(MessageType type) {
  const auto* const found = std::ranges::find(kTypes, type, &TypeName::type);
  return found == std::end(kTypes) ? "" : found->name;
}

std::size_t SizeOf(MessageType type) {
  const auto* const found = std::ranges::find(kTypes, type, &TypeName::type);
  return found == std::end(kTypes) ? 0 : found->size;
}

std::optional<MessageType> FindMessageType(std::string_view name) {
  if (name == "char") return MessageType::kUint8;
  const auto* const found = std::ranges::find(kTypes, name, &TypeName::name);
  return found == std::end(kTypes) ? std::nullopt : std::optional(found->type);
}

std::vector<std::string> MessageTypeNames() { return NamesOf(kTypes, &TypeName::name); }

std::string TextOf(const MessageDefinition& definition) {
  const std::string package = PackageOf(definition.name);
  std::string text;
  for (const MessageConstant& each : definition.constants) {
    text += each.type + " " + each.name + "=" + each.value + "\n";
  }
  for (const MessageField& field : definition.fields) {
    text += TypeTextOf(field, package) + " " + field.name;
    if (!field.default_value.empty()) text += " " + field.default_value;
    if (!field.comment.empty()) text += "  # " + field.comment;
    text += "\n";
  }
  return text;
}

}  // namespace runnel
