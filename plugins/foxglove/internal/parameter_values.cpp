#include "plugins/foxglove/internal/parameter_values.h"

#include <memory>
#include <optional>

#include "core/types/type_of.h"
#include "plugins/json_values/json_values.h"
#include "plugins/json_values/json_writer.h"

namespace runnel::internal {

namespace {

bool IsListOf(const TypeInfo& type, const TypeInfo& element) {
  return type.kind() == TypeKind::kSequence && type.elements().type == &element;
}
bool IsBytes(const TypeInfo& type) { return IsListOf(type, TypeOf<std::uint8_t>()); }
bool IsFloat(const TypeInfo& type) {
  return &type == &TypeOf<double>() || &type == &TypeOf<float>();
}

std::shared_ptr<void> ValueOf(const TypeInfo& type, const std::string& text) {
  auto value = type.is_transparent() ? type.Make() : nullptr;
  if (value && !SetFromText(type, text, value.get())) value = nullptr;
  return value;
}

std::string BytesIn(const TypeInfo& list, void* value) {
  std::string bytes;
  const std::size_t count = list.elements().columns(value);
  for (std::size_t i = 0; i < count; ++i) {
    bytes += *static_cast<const char*>(list.elements().element(value, i));
  }
  return bytes;
}

// Whether people had rather read and write the text format: "20ms", not {"sec":0,"nsec":20000000}.
bool IsShownAsText(const TypeInfo& type, const std::string& json) {
  if (type.kind() == TypeKind::kEnumeration) return true;
  return type.kind() == TypeKind::kLeaf && (json.starts_with('"') || json.starts_with('{'));
}

std::optional<unsigned> DigitOf(char character) {
  if (character >= 'A' && character <= 'Z') return character - 'A';
  if (character >= 'a' && character <= 'z') return character - 'a' + 26;
  if (character >= '0' && character <= '9') return character - '0' + 52;
  if (character == '+') return 62;
  if (character == '/') return 63;
  return std::nullopt;
}

std::optional<std::string> FromBase64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char character : text) {
    const auto digit = DigitOf(character);
    if (!digit) return std::nullopt;
    bits = (bits << 6 | *digit) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

Result<std::string> TextOfBytes(const SetParametersMessage::Item& item, const TypeInfo& type) {
  const auto bytes = item.text ? FromBase64(*item.text) : std::nullopt;
  if (!bytes) return Error{.message = "the value of a byte_array is a text in base64"};
  if (!IsBytes(type)) return Error{.message = "a " + type.name() + " is no list of bytes"};
  std::string text = "[";
  for (const char byte : *bytes) {
    if (text.size() > 1) text += ", ";
    text += std::to_string(static_cast<unsigned char>(byte));
  }
  return text + "]";
}

}  // namespace

void AppendParameter(const std::string& name, const TypeInfo& type, const std::string& text,
                     std::string& json) {
  JsonObject parameter(json);
  parameter.Add("name", name);
  const auto value = ValueOf(type, text);
  if (!value) return parameter.Add("value", text);
  if (IsBytes(type)) {
    std::string& bytes = parameter.Key("value");
    bytes += '"';
    AppendBase64(BytesIn(type, value.get()), bytes);
    bytes += '"';
    return parameter.Add("type", "byte_array");
  }
  std::string as_json;
  AppendJson(type, value.get(), as_json, {.has_infinity = false});
  if (IsShownAsText(type, as_json)) return parameter.Add("value", text);
  parameter.AddJson("value", as_json);
  const bool is_floats = IsListOf(type, TypeOf<double>()) || IsListOf(type, TypeOf<float>());
  if (as_json.find("null") != std::string::npos) return;  // no number, whatever the type
  if (IsFloat(type)) parameter.Add("type", "float64");
  if (is_floats) parameter.Add("type", "float64_array");
}

Result<std::string> TextOfItem(const SetParametersMessage::Item& item, const TypeInfo& type,
                               const std::string& text) {
  if (item.json.empty()) {
    return Error{.message = "a parameter cannot be removed, only set", .hint = "say its \"value\""};
  }
  if (item.type == "byte_array") return TextOfBytes(item, type);
  if (item.text) return *item.text;
  const auto value = ValueOf(type, text);
  if (!value) return Error{.message = "a " + type.name() + " can be set as text only"};
  if (auto set = SetFromJson(type, item.json, value.get()); !set) return set.error();
  return ToText(type, value.get());
}

}  // namespace runnel::internal
