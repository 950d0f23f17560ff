#include "plugins/ros_messages/message_definition.h"

#include <algorithm>
#include <optional>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
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

namespace {

// Up to a '#' that stands in no text.
std::string_view WithoutComment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0) {
      if (line[i] == '\\')
        ++i;
      else if (line[i] == quote)
        quote = 0;
    } else if (line[i] == '#') {
      return line.substr(0, i);
    } else if (line[i] == '"' || line[i] == '\'') {
      quote = line[i];
    }
  }
  return line;
}

// Above 0.
std::optional<std::size_t> NumberOf(std::string_view text) {
  const auto number = runnel::NumberIn<std::size_t>(text);
  return number && *number > 0 ? number : std::nullopt;
}

/// Reads one line after the other.
class MessageParser {
 public:
  MessageParser(const std::string& name, const std::string& file) : file_(file) { definition_.name = name; }

  Result<MessageDefinition> Parse(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = Trimmed(WithoutComment(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (line.empty()) continue;
      if (line == "---") return Wrong("'---' divides services and actions", "leave it out of a .msg file");
      if (auto read = ParseLine(line); !read) return read.error();
    }
    return std::move(definition_);
  }

 private:
  Error Wrong(std::string message, std::string hint) const {
    return {.message = std::move(message), .position = {file_, line_}, .hint = std::move(hint)};
  }

  Result<void> ParseLine(std::string_view line) {
    const std::size_t end = line.find_first_of(" \t");
    if (end == std::string_view::npos) {
      return Wrong("'" + std::string(line) + "' has a type and no name", "write 'float64 speed'");
    }
    const std::string_view type = line.substr(0, end);
    const std::string_view rest = Trimmed(line.substr(end));
    const std::size_t name_end = std::min(rest.find_first_of(" \t="), rest.size());
    const std::string_view name = rest.substr(0, name_end);
    const std::string_view value = Trimmed(rest.substr(name_end));
    if (value.starts_with('=')) return AddConstant(type, name, Trimmed(value.substr(1)));
    return AddField(type, name, value);
  }

  Result<void> AddConstant(std::string_view type, std::string_view name, std::string_view value) {
    const bool is_good_type = FindMessageType(type.substr(0, type.find('<'))).has_value();
    if (!is_good_type)
      return Wrong("a constant is a number, a bool or a string, no '" + std::string(type) + "'", "write 'uint8 ON=1'");
    if (value.empty()) return Wrong("the constant '" + std::string(name) + "' has no value", "write 'uint8 ON=1'");
    definition_.constants.push_back({std::string(type), std::string(name), std::string(value)});
    return {};
  }

  Result<void> AddField(std::string_view type, std::string_view name, std::string_view value) {
    if (!IsRosFieldName(name)) {
      return Wrong("a field cannot be called '" + std::string(name) +
                       "': it has lower-case letters, digits and single '_', and begins with a letter",
                   "write '" + NearestFieldName(name) + "'");
    }
    if (definition_.FindField(name) != nullptr) {
      return Wrong("there is already a field '" + std::string(name) + "'", "give it another name");
    }
    MessageField field{.name = std::string(name), .default_value = std::string(value)};
    if (type.ends_with(']')) {
      const std::size_t bracket = type.rfind('[');
      if (bracket == std::string_view::npos)
        return Wrong("'" + std::string(type) + "' lacks '['", "write 'float64[3]'");
      std::string_view count = type.substr(bracket + 1, type.size() - bracket - 2);
      type = type.substr(0, bracket);
      field.count = count.empty() ? MessageCount::kList : MessageCount::kArray;
      if (count.starts_with("<=")) {
        field.count = MessageCount::kBounded;
        count.remove_prefix(2);
      }
      const auto capacity = NumberOf(count);
      if (!capacity && field.count != MessageCount::kList) {
        return Wrong("'" + std::string(count) + "' is no number of elements", "write '[]', '[3]' or '[<=3]'");
      }
      field.capacity = capacity.value_or(0);
    }
    if (const std::size_t bound = type.find("<="); bound != std::string_view::npos) {
      const auto capacity = NumberOf(type.substr(bound + 2));
      if (!capacity) return Wrong("'" + std::string(type) + "' has no length", "write 'string<=10'");
      field.text_capacity = *capacity;
      type = type.substr(0, bound);
      if (type != "string" && type != "wstring")
        return Wrong("only strings are bounded by '<='", "write 'string<=10' or '" + std::string(type) + "[<=10]'");
    }
    if (auto set = SetType(type, field); !set) return set;
    definition_.fields.push_back(std::move(field));
    return {};
  }

  Result<void> SetType(std::string_view type, MessageField& field) {
    if (const auto primitive = FindMessageType(type)) {
      field.type = *primitive;
      return {};
    }
    const std::size_t slash = type.find('/');
    std::string package = definition_.name.substr(0, definition_.name.find('/'));
    std::string_view name = type;
    if (slash != std::string_view::npos) {
      package = type.substr(0, slash);
      name = type.substr(slash + 1);
      if (name.starts_with("msg/")) name.remove_prefix(4);
    }
    if (!IsRosPackageName(package) || !IsRosMessageName(name)) {
      return Wrong("there is no type '" + std::string(type) + "'", NearestNameHint(type, MessageTypeNames()));
    }
    field.type = MessageType::kNested;
    field.nested = package + "/msg/" + std::string(name);
    return {};
  }

  MessageDefinition definition_;
  const std::string& file_;
  int line_ = 0;
};

}  // namespace

Result<MessageDefinition> ParseMessage(std::string_view text, const std::string& name, const std::string& file) {
  return MessageParser(name, file).Parse(text);
}

}  // namespace runnel
