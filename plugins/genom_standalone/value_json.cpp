#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include "core/base/nearest_name.h"
#include "plugins/genom_standalone/request_server.h"

namespace runnel::genom_standalone {

namespace {

std::byte* At(void* value, std::size_t offset) { return static_cast<std::byte*>(value) + offset; }

Error Wrong(const std::string& path, const std::string& message, std::string hint = {}) {
  return Error{.message = message, .path = path, .hint = std::move(hint)};
}

// In the order of their kinds; behind them are the numbers of enumerators.
using Numbers = std::tuple<bool, std::uint8_t, char, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                           std::int64_t, std::uint64_t, float, double, std::uint32_t>;
static_assert(std::tuple_size_v<Numbers> == static_cast<std::size_t>(ValueKind::kEnum) + 1);

// Calls `use` with the number that the value is, or that stands for it.
template <std::size_t kKind = 0, typename Use>
auto WithNumber(ValueKind kind, void* value, Use use) {
  if constexpr (kKind + 1 < std::tuple_size_v<Numbers>) {
    if (static_cast<std::size_t>(kind) != kKind) return WithNumber<kKind + 1>(kind, value, use);
  }
  return use(*static_cast<std::tuple_element_t<kKind, Numbers>*>(value));
}

// Of a union: which member is set, nullptr if none.
const ValueMember* ChosenMember(const ValueType& type, void* value) {
  const auto chosen =
      WithNumber(type.element->kind, value, [](auto number) { return static_cast<std::int64_t>(number); });
  const ValueMember* otherwise = nullptr;
  for (const ValueMember& each : type.members) {
    if (std::ranges::find(each.labels, chosen) != each.labels.end()) return &each;
    if (each.labels.empty()) otherwise = &each;
  }
  return otherwise;
}

void Choose(const ValueType& type, const ValueMember& member, void* value) {
  type.memory.destroy(value);
  type.memory.make(value);
  WithNumber(type.element->kind, value,
             [&]<typename Number>(Number& number) { number = static_cast<Number>(member.label); });
  member.type->memory.make(At(value, member.offset));
}

template <typename Number>
Result<void> NumberFromJson(const Said& json, Number& number, const std::string& path) {
  if constexpr (std::is_same_v<Number, bool>) {
    if (!json.is_boolean()) return Wrong(path, "is neither true nor false");
  } else if constexpr (std::is_floating_point_v<Number>) {
    if (!json.is_number()) return Wrong(path, "is no number");
    if (std::abs(json.get<double>()) > std::numeric_limits<Number>::max())
      return Wrong(path, json.dump() + " does not fit");
  } else {
    if (std::is_same_v<Number, char> && json.is_string() && json.get_ref<const std::string&>().size() == 1) {
      number = static_cast<Number>(json.get_ref<const std::string&>()[0]);
      return {};
    }
    if (!json.is_number_integer()) return Wrong(path, "is no whole number");
    using Limits = std::numeric_limits<Number>;
    const bool fits = json.is_number_unsigned() ? std::cmp_less_equal(json.get<std::uint64_t>(), +Limits::max())
                                                : std::cmp_greater_equal(json.get<std::int64_t>(), +Limits::min());
    if (!fits) return Wrong(path, json.dump() + " does not fit");
  }
  number = json.get<Number>();
  return {};
}

Result<void> EnumFromJson(const ValueType& type, const Said& json, void* value, const std::string& path) {
  if (!json.is_string()) return Wrong(path, "is no name");
  const auto& name = json.get_ref<const std::string&>();
  const auto found = std::ranges::find(type.names, name);
  if (found == type.names.end()) {
    return Wrong(path, "there is no '" + name + "'",
                 NearestNameHint(name, std::vector<std::string>(type.names.begin(), type.names.end())));
  }
  *static_cast<std::uint32_t*>(value) = static_cast<std::uint32_t>(found - type.names.begin());
  return {};
}

Result<void> TextFromJson(const ValueType& type, const Said& json, void* value, const std::string& path) {
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
  static_cast<genom_execution::OwnedText*>(value)->Set(text);
  return {};
}

Result<void> ListFromJson(const ValueType& type, const Said& json, void* value, const std::string& path) {
  if (!json.is_array()) return Wrong(path, "is no list");
  if (json.size() >= 100'000'000 || !type.list->resize(value, json.size())) {
    return Wrong(path, "has more than " + std::to_string(type.length) + " elements");
  }
  Result<void> result;
  std::size_t i = 0;
  type.list->for_each(value, [&](void* element) {
    if (i >= json.size()) return false;  // what is not said of an array
    result = FromJson(*type.element, json[i], element, path + "[" + std::to_string(i) + "]");
    ++i;
    return result.has_value();
  });
  return result;
}

Result<void> MembersFromJson(const ValueType& type, const Said& json, void* value, const std::string& path) {
  if (!json.is_object()) return Wrong(path, "is no object");
  if (type.kind == ValueKind::kUnion && json.size() != 1) return Wrong(path, "is a union: say one of its members");
  for (const auto& [name, part] : json.items()) {
    const auto found = std::ranges::find(type.members, name, &ValueMember::name);
    if (found == type.members.end()) {
      return Wrong(path, "there is no '" + name + "'",
                   NearestNameHint(name, NamesOf(type.members, &ValueMember::name)));
    }
    if (type.kind == ValueKind::kUnion) Choose(type, *found, value);
    auto read = FromJson(*found->type, part, At(value, found->offset), path.empty() ? name : path + "." + name);
    if (!read) return read;
  }
  return {};
}

}  // namespace

Json ToJson(const ValueType& type, const void* from) {
  void* const value = const_cast<void*>(from);  // it is not changed
  switch (type.kind) {
    case ValueKind::kEnum: {
      const auto number = *static_cast<std::uint32_t*>(value);
      return number < type.names.size() ? Json(type.names[number]) : Json(number);
    }
    case ValueKind::kText: {
      const auto* const text = static_cast<const char*>(value);
      return std::string(text, strnlen(text, type.length));
    }
    case ValueKind::kOwnedText:
      return static_cast<genom_execution::OwnedText*>(value)->view();
    case ValueKind::kString:
      return *static_cast<std::string*>(value);
    case ValueKind::kList: {
      Json list = Json::array();
      type.list->for_each(value, [&](void* element) {
        list.push_back(ToJson(*type.element, element));
        return true;
      });
      return list;
    }
    case ValueKind::kOptional:
      return *static_cast<bool*>(value) ? ToJson(*type.element, At(value, type.element_offset)) : Json(nullptr);
    case ValueKind::kStruct: {
      Json object = Json::object();
      for (const ValueMember& each : type.members) object[each.name] = ToJson(*each.type, At(value, each.offset));
      return object;
    }
    case ValueKind::kUnion: {
      const ValueMember* const chosen = ChosenMember(type, value);
      return chosen != nullptr ? Json{{chosen->name, ToJson(*chosen->type, At(value, chosen->offset))}}
                               : Json::object();
    }
    case ValueKind::kNative:
      return nullptr;
    default:
      return WithNumber(type.kind, value, [](auto number) -> Json { return number; });
  }
}

Result<void> FromJson(const ValueType& type, const Said& json, void* value, const std::string& path) {
  switch (type.kind) {
    case ValueKind::kEnum:
      return EnumFromJson(type, json, value, path);
    case ValueKind::kText:
    case ValueKind::kOwnedText:
    case ValueKind::kString:
      return TextFromJson(type, json, value, path);
    case ValueKind::kList:
      return ListFromJson(type, json, value, path);
    case ValueKind::kOptional: {
      const bool is_present = !json.is_null();
      *static_cast<bool*>(value) = is_present;
      return is_present ? FromJson(*type.element, json, At(value, type.element_offset), path) : Result<void>();
    }
    case ValueKind::kStruct:
    case ValueKind::kUnion:
      return MembersFromJson(type, json, value, path);
    case ValueKind::kNative:
      return Wrong(path, "is of the component alone");
    default:
      return WithNumber(type.kind, value, [&](auto& number) { return NumberFromJson(json, number, path); });
  }
}

Result<void> CheckAllAreSaid(const ValueType& type, const Said& json, const std::string& path) {
  Result<void> all;
  if (type.kind == ValueKind::kOptional && !json.is_null()) return CheckAllAreSaid(*type.element, json, path);
  if (type.kind == ValueKind::kList) {
    if (type.is_array && json.size() < type.length) {
      return Wrong(path, "has fewer than " + std::to_string(type.length) + " elements", "say all of them");
    }
    for (std::size_t i = 0; all && i < json.size(); ++i) {
      all = CheckAllAreSaid(*type.element, json[i], path + "[" + std::to_string(i) + "]");
    }
  }
  if (type.kind != ValueKind::kStruct && type.kind != ValueKind::kUnion) return all;
  for (const ValueMember& each : type.members) {
    const std::string name = path + "." + each.name;
    if (json.contains(each.name)) {
      all = CheckAllAreSaid(*each.type, json[each.name], name);
    } else if (type.kind == ValueKind::kStruct && each.type->kind != ValueKind::kOptional) {
      return Wrong(name, "is not given", "say all members");
    }
    if (!all) return all;
  }
  return all;
}

}  // namespace runnel::genom_standalone
