#include "plugins/genom_standalone/value_json.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "core/base/nearest_name.h"
#include "plugins/genom_standalone/value_memory.h"

namespace runnel::genom_standalone {

namespace {

const std::byte* At(const void* value, std::size_t offset) { return static_cast<const std::byte*>(value) + offset; }
std::byte* At(void* value, std::size_t offset) { return static_cast<std::byte*>(value) + offset; }

Error Wrong(const std::string& path, const std::string& message, std::string hint = {}) {
  return Error{.message = message, .path = path, .hint = std::move(hint)};
}

struct Limits {
  std::int64_t least, most;
};

Limits LimitsOf(ValueKind kind) {
  switch (kind) {
    case ValueKind::kOctet: return {0, 255};
    case ValueKind::kCharacter: return {std::numeric_limits<char>::min(), std::numeric_limits<char>::max()};
    case ValueKind::kShort: return {-32768, 32767};
    case ValueKind::kUnsignedShort: return {0, 65535};
    case ValueKind::kLong: return {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()};
    case ValueKind::kUnsignedLong: return {0, std::numeric_limits<std::uint32_t>::max()};
    default: return {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()};
  }
}

Result<void> WholeFromJson(const ValueType& type, const Json& json, void* value, const std::string& path) {
  if (type.kind == ValueKind::kCharacter && json.is_string() && json.get_ref<const std::string&>().size() == 1) {
    SetWholeNumber(type, value, json.get_ref<const std::string&>()[0]);
    return {};
  }
  if (!json.is_number_integer()) return Wrong(path, "is no whole number");
  if (type.kind == ValueKind::kUnsignedLongLong) {
    if (!json.is_number_unsigned()) return Wrong(path, "is negative");
    SetWholeNumber(type, value, static_cast<std::int64_t>(json.get<std::uint64_t>()));
    return {};
  }
  const Limits limits = LimitsOf(type.kind);
  const bool is_too_large = json.is_number_unsigned() && json.get<std::uint64_t>() > static_cast<std::uint64_t>(limits.most);
  if (is_too_large || json.get<std::int64_t>() < limits.least) return Wrong(path, json.dump() + " does not fit");
  SetWholeNumber(type, value, json.get<std::int64_t>());
  return {};
}

Result<void> EnumFromJson(const ValueType& type, const Json& json, void* value, const std::string& path) {
  if (!json.is_string()) return Wrong(path, "is no name");
  const auto& name = json.get_ref<const std::string&>();
  const auto found = std::ranges::find(type.names, name);
  if (found == type.names.end()) {
    return Wrong(path, "there is no '" + name + "'", NearestNameHint(name, std::vector<std::string>(type.names.begin(), type.names.end())));
  }
  SetWholeNumber(type, value, found - type.names.begin());
  return {};
}

Result<void> TextFromJson(const ValueType& type, const Json& json, void* value, const std::string& path) {
  if (!json.is_string()) return Wrong(path, "is no text");
  const auto& text = json.get_ref<const std::string&>();
  if (type.kind == ValueKind::kText) {
    if (text.size() > type.length) return Wrong(path, "is longer than " + std::to_string(type.length));
    std::memset(value, 0, type.length);
    std::memcpy(value, text.data(), text.size());
    return {};
  }
  if (type.kind == ValueKind::kString) {
    *static_cast<std::string*>(value) = text;
    return {};
  }
  char* owned = nullptr;
  std::memcpy(&owned, value, sizeof(owned));
  std::free(owned);
  owned = strdup(text.c_str());
  std::memcpy(value, &owned, sizeof(owned));
  return {};
}

Result<void> ListFromJson(const ValueType& type, const Json& json, void* value, const std::string& path) {
  if (!json.is_array()) return Wrong(path, "is no list");
  const bool is_array = type.kind == ValueKind::kArray;
  const bool fits = is_array ? json.size() <= type.length : json.size() < 100'000'000 && Resize(type, value, static_cast<std::uint32_t>(json.size()));
  if (!fits) return Wrong(path, "has more than " + std::to_string(type.length) + " elements");
  Result<void> result;
  std::size_t i = 0;
  ForEachElement(type, value, [&](void* element) {
    if (i >= json.size()) return false;  // what is not said of an array
    result = FromJson(*type.element, json[i], element, path + "[" + std::to_string(i) + "]");
    ++i;
    return result.has_value();
  });
  return result;
}

Result<void> MembersFromJson(const ValueType& type, const Json& json, void* value, const std::string& path) {
  if (!json.is_object()) return Wrong(path, "is no object");
  if (type.kind == ValueKind::kUnion && json.size() != 1) return Wrong(path, "is a union: say one of its members");
  for (const auto& [name, part] : json.items()) {
    const auto found = std::ranges::find_if(type.members, [&](const ValueMember& each) { return each.name == name; });
    if (found == type.members.end()) {
      return Wrong(path, "there is no '" + name + "'", NearestNameHint(name, NamesOf(type.members, &ValueMember::name)));
    }
    if (type.kind == ValueKind::kUnion) {
      Release(type, value);
      SetWholeNumber(*type.element, value, found->label);
      Initialise(*found->type, At(value, found->offset));
    }
    auto read = FromJson(*found->type, part, At(value, found->offset), path.empty() ? name : path + "." + name);
    if (!read) return read;
  }
  return {};
}

}  // namespace

Json ToJson(const ValueType& type, const void* value) {
  switch (type.kind) {
    case ValueKind::kBoolean: return WholeNumber(type, value) != 0;
    case ValueKind::kUnsignedLongLong: return static_cast<std::uint64_t>(WholeNumber(type, value));
    case ValueKind::kFloat: {
      float number;
      std::memcpy(&number, value, sizeof(number));
      return number;
    }
    case ValueKind::kDouble: {
      double number;
      std::memcpy(&number, value, sizeof(number));
      return number;
    }
    case ValueKind::kEnum: {
      const auto number = static_cast<std::size_t>(WholeNumber(type, value));
      return number < type.names.size() ? Json(type.names[number]) : Json(number);
    }
    case ValueKind::kText: {
      const auto* const text = static_cast<const char*>(value);
      return std::string(text, strnlen(text, type.length));
    }
    case ValueKind::kOwnedText: {
      const char* text = nullptr;
      std::memcpy(&text, value, sizeof(text));
      return text != nullptr ? text : "";
    }
    case ValueKind::kString: return *static_cast<const std::string*>(value);
    case ValueKind::kArray: case ValueKind::kSequence: case ValueKind::kOwnedSequence: case ValueKind::kList: {
      Json list = Json::array();
      ForEachElement(type, const_cast<void*>(value), [&](void* element) {
        list.push_back(ToJson(*type.element, element));
        return true;
      });
      return list;
    }
    case ValueKind::kOptional:
      return *static_cast<const bool*>(value) ? ToJson(*type.element, At(value, type.element_offset)) : Json(nullptr);
    case ValueKind::kStruct: {
      Json object = Json::object();
      for (const ValueMember& each : type.members) object[each.name] = ToJson(*each.type, At(value, each.offset));
      return object;
    }
    case ValueKind::kUnion: {
      const ValueMember* const chosen = ChosenMember(type, value);
      return chosen != nullptr ? Json{{chosen->name, ToJson(*chosen->type, At(value, chosen->offset))}} : Json::object();
    }
    case ValueKind::kNative: return nullptr;
    default: return WholeNumber(type, value);
  }
}

Result<void> FromJson(const ValueType& type, const Json& json, void* value, const std::string& path) {
  switch (type.kind) {
    case ValueKind::kBoolean:
      if (!json.is_boolean()) return Wrong(path, "is neither true nor false");
      SetWholeNumber(type, value, json.get<bool>());
      return {};
    case ValueKind::kFloat: {
      if (!json.is_number()) return Wrong(path, "is no number");
      const float number = json.get<float>();
      std::memcpy(value, &number, sizeof(number));
      return {};
    }
    case ValueKind::kDouble: {
      if (!json.is_number()) return Wrong(path, "is no number");
      const double number = json.get<double>();
      std::memcpy(value, &number, sizeof(number));
      return {};
    }
    case ValueKind::kEnum: return EnumFromJson(type, json, value, path);
    case ValueKind::kText: case ValueKind::kOwnedText: case ValueKind::kString: return TextFromJson(type, json, value, path);
    case ValueKind::kArray: case ValueKind::kSequence: case ValueKind::kOwnedSequence: case ValueKind::kList:
      return ListFromJson(type, json, value, path);
    case ValueKind::kOptional: {
      const bool is_present = !json.is_null();
      *static_cast<bool*>(value) = is_present;
      return is_present ? FromJson(*type.element, json, At(value, type.element_offset), path) : Result<void>();
    }
    case ValueKind::kStruct: case ValueKind::kUnion: return MembersFromJson(type, json, value, path);
    case ValueKind::kNative: return Wrong(path, "is of the component alone");
    default: return WholeFromJson(type, json, value, path);
  }
}

}  // namespace runnel::genom_standalone
