#include "plugins/ros_messages/parameter_messages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/element/configurable.h"
#include "core/types/leaf_types.h"
#include "core/types/text_format.h"

namespace runnel {

namespace {

using Type = RosParameterType;

template <typename T>
constexpr bool kIsInteger = std::is_integral_v<T> && !std::is_same_v<T, bool>;

// False if it is none of ROS 2's kinds.
bool SetNumberOrText(const TypeInfo& type, const void* at, RosParameterValue& value) {
  if (type.kind() != TypeKind::kLeaf) return false;
  return WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_same_v<T, bool>) {
      value.type = Type::kBool;
      value.bool_value = *static_cast<const T*>(at);
    } else if constexpr (kIsInteger<T>) {
      const T number = *static_cast<const T*>(at);
      if (!std::in_range<std::int64_t>(number)) return false;
      value.type = Type::kInteger;
      value.integer_value = static_cast<std::int64_t>(number);
    } else if constexpr (std::is_floating_point_v<T>) {
      value.type = Type::kDouble;
      value.double_value = static_cast<double>(*static_cast<const T*>(at));
    } else {
      return false;
    }
    return true;
  });
}

template <typename T, typename Listed>
bool AddAll(const TypeInfo& type, const void* at, std::vector<Listed>& list, RosParameterValue& value, Type as) {
  const ElementOperations& elements = type.elements();
  for (std::size_t i = 0; i < elements.columns(at); ++i) {
    const auto& each = *static_cast<const T*>(elements.element(ForLooking(at), i));
    if constexpr (kIsInteger<T>) {
      if (!std::in_range<Listed>(each)) return false;
    }
    list.push_back(static_cast<Listed>(each));
  }
  value.type = as;
  return true;
}

bool SetList(const TypeInfo& type, const void* at, RosParameterValue& value) {
  if (type.kind() != TypeKind::kSequence || type.elements().type->kind() != TypeKind::kLeaf) return false;
  return WithLeafType(*type.elements().type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_same_v<T, bool>) return AddAll<T>(type, at, value.bool_array_value, value, Type::kBoolArray);
    if constexpr (std::is_same_v<T, std::uint8_t>)
      return AddAll<T>(type, at, value.byte_array_value, value, Type::kByteArray);
    if constexpr (kIsInteger<T>) return AddAll<T>(type, at, value.integer_array_value, value, Type::kIntegerArray);
    if constexpr (std::is_floating_point_v<T>)
      return AddAll<T>(type, at, value.double_array_value, value, Type::kDoubleArray);
    if constexpr (std::is_same_v<T, std::string>)
      return AddAll<T>(type, at, value.string_array_value, value, Type::kStringArray);
    return false;
  });
}

template <typename Range>
bool SetRange(const ConfigurableInfo& info, std::vector<Range>& ranges) {
  if (!info.minimum && !info.maximum) return false;
  using Number = decltype(Range::from_value);
  constexpr std::numeric_limits<Number> kLimits;
  Range range;
  // A bound of a number may lie beyond what ROS 2 has for it.
  const auto held = [&](double bound, Number instead) {
    if constexpr (std::is_integral_v<Number>) {
      return std::abs(bound) < 9.2e18 ? static_cast<Number>(bound) : instead;
    } else {
      return bound;
    }
  };
  range.from_value = info.minimum ? held(*info.minimum, kLimits.lowest()) : kLimits.lowest();
  range.to_value = info.maximum ? held(*info.maximum, kLimits.max()) : kLimits.max();
  ranges.push_back(range);
  return true;
}

}  // namespace

RosParameterValue ToRosParameter(const TypeInfo& type, const void* at) {
  RosParameterValue value;
  if (SetNumberOrText(type, at, value) || SetList(type, at, value)) return value;
  RosParameterValue text;
  text.type = Type::kString;
  text.string_value = ToText(type, at);
  return text;
}

Result<std::string> TextOf(const RosParameterValue& value, const TypeInfo& type) {
  const bool is_list = type.kind() == TypeKind::kSequence;
  if (value.type >= Type::kByteArray && !is_list) {
    return Error{.message = "a " + type.name() + " is no list", .hint = "give one value"};
  }
  if (value.type == Type::kNotSet) return Error{.message = "a parameter cannot be deleted", .hint = "give it a value"};
  if (value.type == Type::kBool) return TextOf(value.bool_value);
  if (value.type == Type::kInteger) return TextOf(value.integer_value);
  if (value.type == Type::kDouble) return TextOf(value.double_value);
  if (value.type == Type::kString) return value.string_value;
  if (value.type == Type::kByteArray) return TextOf(value.byte_array_value);
  if (value.type == Type::kIntegerArray) return TextOf(value.integer_array_value);
  if (value.type == Type::kDoubleArray) return TextOf(value.double_array_value);
  if (value.type == Type::kStringArray) return TextOf(value.string_array_value);
  std::string text = "[";
  for (const std::uint8_t each : value.bool_array_value) {
    text += (text.size() > 1 ? ", " : "") + TextOf(each != 0);
  }
  return text + "]";
}

std::string RosParameterName(std::string_view application, std::string_view path) {
  if (path.starts_with(application)) path.remove_prefix(application.size());
  while (path.starts_with('/')) path.remove_prefix(1);
  std::string name(path);
  std::ranges::replace(name, '/', '.');
  return name;
}

RosParameterDescriptor DescribeRosParameter(std::string name, const Configurable& parameter) {
  const ConfigurableInfo& info = parameter.info();
  const std::shared_ptr<const void> value = parameter.Value();
  RosParameterDescriptor descriptor;
  descriptor.name = std::move(name);
  descriptor.type = ToRosParameter(parameter.type(), value.get()).type;
  descriptor.description = info.description;
  if (!info.unit.empty()) descriptor.description += (info.description.empty() ? "" : " ") + ("[" + info.unit + "]");
  descriptor.read_only = info.is_static;
  bool has_range = false;
  if (descriptor.type == Type::kDouble) has_range = SetRange(info, descriptor.floating_point_range);
  if (descriptor.type == Type::kInteger) has_range = SetRange(info, descriptor.integer_range);
  if (!has_range) descriptor.additional_constraints = info.bounds;
  return descriptor;
}

}  // namespace runnel
