#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/types/type_of.h"

namespace runnel {

class Configurable;

/// What `ros2 param` speaks: values of parameters as messages of rcl_interfaces, and the six services of a node. Each
/// structure has the octets of its message (WriteCdr(), ReadCdr()).

/// rcl_interfaces/msg/ParameterType.
enum class RosParameterType : std::uint8_t {
  kNotSet,
  kBool,
  kInteger,
  kDouble,
  kString,
  kByteArray,
  kBoolArray,
  kIntegerArray,
  kDoubleArray,
  kStringArray,
};

/// rcl_interfaces/msg/ParameterValue: the one that `type` says counts.
struct RosParameterValue {
  RosParameterType type = RosParameterType::kNotSet;
  bool bool_value = false;
  std::int64_t integer_value = 0;
  double double_value = 0;
  std::string string_value;
  std::vector<std::uint8_t> byte_array_value;
  std::vector<std::uint8_t> bool_array_value;  ///< 0 or 1 each
  std::vector<std::int64_t> integer_array_value;
  std::vector<double> double_array_value;
  std::vector<std::string> string_array_value;

  friend bool operator==(const RosParameterValue&, const RosParameterValue&) = default;
};

/// What a value of a parameter is for ROS 2: numbers and bools as such, lists of them as arrays, all else as its text.
/// A uint64 beyond 2^63 is a text, too.
[[nodiscard]] RosParameterValue ToRosParameter(const TypeInfo& type, const void* value);
/// As a person sees it: "0.5", "left", "[1, 2]": Configurable::Parse() reads it, so that bounds and units are held.
/// Errors: it is not set; an array that the type is not.
[[nodiscard]] Result<std::string> TextOf(const RosParameterValue& value, const TypeInfo& type);

/// "planner.distance" for the path "/robot/planner/distance" of the application "/robot".
[[nodiscard]] std::string RosParameterName(std::string_view application, std::string_view path);

/// rcl_interfaces/msg/Parameter.
struct RosParameter {
  std::string name;
  RosParameterValue value;
};

struct RosFloatRange {
  double from_value = 0, to_value = 0, step = 0;
};
struct RosIntegerRange {
  std::int64_t from_value = 0, to_value = 0;
  std::uint64_t step = 0;
};
/// rcl_interfaces/msg/ParameterDescriptor.
struct RosParameterDescriptor {
  std::string name;
  RosParameterType type = RosParameterType::kNotSet;
  std::string description;
  std::string additional_constraints;
  bool read_only = false;
  bool dynamic_typing = false;
  std::vector<RosFloatRange> floating_point_range;
  std::vector<RosIntegerRange> integer_range;
};
/// Name, type, unit, bounds and whether it can be set, as Runnel knows them. Any thread.
[[nodiscard]] RosParameterDescriptor DescribeRosParameter(std::string name, const Configurable& parameter);

/// rcl_interfaces/msg/SetParametersResult.
struct RosSetResult {
  bool successful = false;
  std::string reason;
};

// Requests and replies; rcl_interfaces/srv/ListParameters_Request and so on. Those that have one list alone are that list,
// whose octets are the same: names, values, types, descriptors, parameters, results.
struct RosListRequest {
  std::vector<std::string> prefixes;
  std::uint64_t depth = 0;  ///< 0: all
};
struct RosListReply {
  std::vector<std::string> names;
  std::vector<std::string> prefixes;
};
/// rcl_interfaces/msg/ParameterEvent, of the topic /parameter_events.
struct RosParameterEvent {
  Time stamp{};
  std::string node;
  std::vector<RosParameter> new_parameters, changed_parameters, deleted_parameters;
};

inline void Describe(TypeBuilder<RosParameterType>& type) {
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
inline void Describe(TypeBuilder<RosParameterValue>& type) {
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
inline void Describe(TypeBuilder<RosParameter>& type) {
  type.Name("ros.Parameter").Field("name", &RosParameter::name).Field("value", &RosParameter::value);
}
inline void Describe(TypeBuilder<RosFloatRange>& type) {
  type.Name("ros.FloatingPointRange")
      .Field("from_value", &RosFloatRange::from_value)
      .Field("to_value", &RosFloatRange::to_value)
      .Field("step", &RosFloatRange::step);
}
inline void Describe(TypeBuilder<RosIntegerRange>& type) {
  type.Name("ros.IntegerRange")
      .Field("from_value", &RosIntegerRange::from_value)
      .Field("to_value", &RosIntegerRange::to_value)
      .Field("step", &RosIntegerRange::step);
}
inline void Describe(TypeBuilder<RosParameterDescriptor>& type) {
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
inline void Describe(TypeBuilder<RosSetResult>& type) {
  type.Name("ros.SetParametersResult")
      .Field("successful", &RosSetResult::successful)
      .Field("reason", &RosSetResult::reason);
}
inline void Describe(TypeBuilder<RosListRequest>& type) {
  type.Name("ros.ListParameters_Request")
      .Field("prefixes", &RosListRequest::prefixes)
      .Field("depth", &RosListRequest::depth);
}
inline void Describe(TypeBuilder<RosListReply>& type) {
  type.Name("ros.ListParametersResult").Field("names", &RosListReply::names).Field("prefixes", &RosListReply::prefixes);
}
inline void Describe(TypeBuilder<RosParameterEvent>& type) {
  type.Name("ros.ParameterEvent")
      .Field("stamp", &RosParameterEvent::stamp)
      .Field("node", &RosParameterEvent::node)
      .Field("new_parameters", &RosParameterEvent::new_parameters)
      .Field("changed_parameters", &RosParameterEvent::changed_parameters)
      .Field("deleted_parameters", &RosParameterEvent::deleted_parameters);
}

}  // namespace runnel
