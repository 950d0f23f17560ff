#include <cstring>
#include <memory>

#include "core/base/exception_text.h"
#include "core/types/type_of.h"
#include "plugins/foxglove/internal/parameter_handler.h"
#include "plugins/values/base64.h"
#include "plugins/values/json_values.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

bool IsListOf(const TypeInfo& type, const TypeInfo& element) {
  return type.kind() == TypeKind::kSequence && type.elements().type == &element;
}
bool IsBytes(const TypeInfo& type) { return IsListOf(type, TypeOf<std::uint8_t>()); }

// What the protocol calls it; "" for what has no name there.
const char* KindOf(const TypeInfo& type) {
  if (IsBytes(type)) return "byte_array";
  if (&type == &TypeOf<double>() || &type == &TypeOf<float>()) return "float64";
  const bool is_list = IsListOf(type, TypeOf<double>()) || IsListOf(type, TypeOf<float>());
  return is_list ? "float64_array" : "";
}

// Whether people had rather read and write the text format: "20ms", not {"sec":0,"nsec":20000000}.
bool IsShownAsText(const TypeInfo& type, const std::string& json) {
  if (type.kind() == TypeKind::kEnumeration) return true;
  return type.kind() == TypeKind::kLeaf && (json.starts_with('"') || json.starts_with('{'));
}

std::string ValueJson(const Configurable& parameter) {
  const TypeInfo& type = parameter.type();
  const std::shared_ptr<void> value = parameter.Value();
  std::string json;
  if (IsBytes(type)) {
    AppendBase64(type, value.get(), json);
    return json;
  }
  if (type.is_transparent()) AppendJson(type, value.get(), json, {.has_infinity = false});
  if (!json.empty() && !IsShownAsText(type, json)) return json;
  json.clear();
  AppendJsonString(ToText(type, value.get()), json);
  return json;
}

Result<SetParameter> SettingOfBytes(const SetParametersMessage::Item& item, const std::string& path,
                                    const TypeInfo& type) {
  const auto text = item.value->text();
  const auto bytes = text ? FromBase64(*text) : std::nullopt;
  if (!bytes) return Error{.message = "the value of a byte_array is a text in base64"};
  if (!IsBytes(type)) return Error{.message = "a " + type.name() + " is no list of bytes"};
  const std::shared_ptr<void> list = type.Make();
  if (!type.elements().resize(list.get(), 1, bytes->size())) {
    return Error{.message = std::to_string(bytes->size()) + " bytes are no " + type.name()};
  }
  for (std::size_t i = 0; i < bytes->size(); ++i) {
    std::memcpy(type.elements().element(list.get(), i), &(*bytes)[i], 1);
  }
  return SetParameter{path, "", list, &type};
}

}  // namespace

std::string ParameterJson(const std::string& name, const Configurable& parameter) {
  std::string value;
  const char* kind = "";
  try {
    value = ValueJson(parameter);
    // Numbers that are none are null, which no type of the protocol allows.
    if (value.find("null") == std::string::npos) kind = KindOf(parameter.type());
  } catch (...) {
    AppendJsonString("(" + DescribeException() + ")", value);
  }
  return JsonObjectText([&](JsonObject& object) {
    object.Add("name", name).AddJson("value", value);
    if (*kind != '\0') object.Add("type", kind);
  });
}

Result<SetParameter> SettingOf(const SetParametersMessage::Item& item, const std::string& path,
                               const Configurable& parameter) {
  const TypeInfo& type = parameter.type();
  if (!item.value) {
    return Error{.message = "a parameter cannot be removed, only set", .hint = "say its \"value\""};
  }
  if (item.type == "byte_array") return SettingOfBytes(item, path, type);
  if (const auto text = item.value->text()) return SetParameter{path, *text};
  if (!type.is_transparent()) {
    return Error{.message = "a " + type.name() + " can be set as text only"};
  }
  const std::shared_ptr<void> value = parameter.Value();
  if (auto set = SetFromJson(type, *item.value, value.get()); !set) return set.error();
  return SetParameter{path, "", value, &type};
}

}  // namespace runnel::internal
