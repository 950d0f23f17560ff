#include "plugins/ros_messages/parameter_messages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/element/configurable.h"
#include "core/types/leaf_types.h"
#include "core/types/text_format.h"
#include "core/types/type_of.h"

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
    if constexpr (std::is_same_v<T, std::uint8_t>) return AddAll<T>(type, at, value.byte_array_value, value, Type::kByteArray);
    if constexpr (kIsInteger<T>) return AddAll<T>(type, at, value.integer_array_value, value, Type::kIntegerArray);
    if constexpr (std::is_floating_point_v<T>) return AddAll<T>(type, at, value.double_array_value, value, Type::kDoubleArray);
    if constexpr (std::is_same_v<T, std::string>) return AddAll<T>(type, at, value.string_array_value, value, Type::kStringArray);
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
  switch (value.type) {
    case Type::kBool:
      return TextOf(value.bool_value);
    case Type::kInteger:
      return TextOf(value.integer_value);
    case Type::kDouble:
      return TextOf(value.double_value);
    case Type::kString:
      return value.string_value;
    case Type::kByteArray:
      return TextOf(value.byte_array_value);
    case Type::kBoolArray: {
      std::string text = "[";
      for (const std::uint8_t each : value.bool_array_value) {
        text += (text.size() > 1 ? ", " : "") + TextOf(each != 0);
      }
      return text + "]";
    }
    case Type::kIntegerArray:
      return TextOf(value.integer_array_value);
    case Type::kDoubleArray:
      return TextOf(value.double_array_value);
    case Type::kStringArray:
      return TextOf(value.string_array_value);
    case Type::kNotSet:
      break;
  }
  return Error{.message = "a parameter cannot be deleted", .hint = "give it a value"};
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

void Describe(TypeBuilder<RosParameterType>& type) {
  type.Name("ros.ParameterType")
      .Value("not_set", RosParameterType::kNotSet)
      .Value("bool", RosParameterType::kBool)
      .Value("integer", RosParameterType::kInteger)
      .Value("double", RosParameterType::kDouble)
      .Value("string", RosParameterType::kString)
      .Value("byte_array", RosParameterType::kByteArray)
      .Value("bool_array", RosParameterType::kBoolArray)
      .Value("integer_array", RosParameterType::kIntegerArray)
      .Value("double_array", RosParameterType::kDoubleArray)
      .Value("string_array", RosParameterType::kStringArray);
}
void Describe(TypeBuilder<RosParameterValue>& type) {
  type.Name("ros.ParameterValue")
      .Field("type", &RosParameterValue::type)
      .Field("bool_value", &RosParameterValue::bool_value)
      .Field("integer_value", &RosParameterValue::integer_value)
      .Field("double_value", &RosParameterValue::double_value)
      .Field("string_value", &RosParameterValue::string_value)
      .Field("byte_array_value", &RosParameterValue::byte_array_value)
      .Field("bool_array_value", &RosParameterValue::bool_array_value)
      .Field("integer_array_value", &RosParameterValue::integer_array_value)
      .Field("double_array_value", &RosParameterValue::double_array_value)
      .Field("string_array_value", &RosParameterValue::string_array_value);
}
void Describe(TypeBuilder<RosParameter>& type) {
  type.Name("ros.Parameter").Field("name", &RosParameter::name).Field("value", &RosParameter::value);
}
void Describe(TypeBuilder<RosFloatRange>& type) {
  type.Name("ros.FloatingPointRange")
      .Field("from_value", &RosFloatRange::from_value)
      .Field("to_value", &RosFloatRange::to_value)
      .Field("step", &RosFloatRange::step);
}
void Describe(TypeBuilder<RosIntegerRange>& type) {
  type.Name("ros.IntegerRange")
      .Field("from_value", &RosIntegerRange::from_value)
      .Field("to_value", &RosIntegerRange::to_value)
      .Field("step", &RosIntegerRange::step);
}
void Describe(TypeBuilder<RosParameterDescriptor>& type) {
  type.Name("ros.ParameterDescriptor")
      .Field("name", &RosParameterDescriptor::name)
      .Field("type", &RosParameterDescriptor::type)
      .Field("description", &RosParameterDescriptor::description)
      .Field("additional_constraints", &RosParameterDescriptor::additional_constraints)
      .Field("read_only", &RosParameterDescriptor::read_only)
      .Field("dynamic_typing", &RosParameterDescriptor::dynamic_typing)
      .Field("floating_point_range", &RosParameterDescriptor::floating_point_range)
      .Field("integer_range", &RosParameterDescriptor::integer_range);
}
void Describe(TypeBuilder<RosSetResult>& type) {
  type.Name("ros.SetParametersResult")
      .Field("successful", &RosSetResult::successful)
      .Field("reason", &RosSetResult::reason);
}
void Describe(TypeBuilder<RosParameterNames>& type) {
  type.Name("ros.ParameterNames").Field("names", &RosParameterNames::names);
}
void Describe(TypeBuilder<RosParameterDescriptors>& type) {
  type.Name("ros.ParameterDescriptors").Field("descriptors", &RosParameterDescriptors::descriptors);
}
void Describe(TypeBuilder<RosParameterTypes>& type) {
  type.Name("ros.ParameterTypes").Field("types", &RosParameterTypes::types);
}
void Describe(TypeBuilder<RosParameterValues>& type) {
  type.Name("ros.ParameterValues").Field("values", &RosParameterValues::values);
}
void Describe(TypeBuilder<RosListRequest>& type) {
  type.Name("ros.ListParameters_Request")
      .Field("prefixes", &RosListRequest::prefixes)
      .Field("depth", &RosListRequest::depth);
}
void Describe(TypeBuilder<RosListReply>& type) {
  type.Name("ros.ListParametersResult")
      .Field("names", &RosListReply::names)
      .Field("prefixes", &RosListReply::prefixes);
}
void Describe(TypeBuilder<RosSetRequest>& type) {
  type.Name("ros.SetParameters_Request").Field("parameters", &RosSetRequest::parameters);
}
void Describe(TypeBuilder<RosSetReply>& type) {
  type.Name("ros.SetParameters_Response").Field("results", &RosSetReply::results);
}
void Describe(TypeBuilder<RosParameterEvent>& type) {
  type.Name("ros.ParameterEvent")
      .Field("stamp", &RosParameterEvent::stamp)
      .Field("node", &RosParameterEvent::node)
      .Field("new_parameters", &RosParameterEvent::new_parameters)
      .Field("changed_parameters", &RosParameterEvent::changed_parameters)
      .Field("deleted_parameters", &RosParameterEvent::deleted_parameters);
}

}  // namespace runnel
