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
      .Values<RosParameterType::kNotSet, RosParameterType::kBool, RosParameterType::kInteger, RosParameterType::kDouble,
              RosParameterType::kString, RosParameterType::kByteArray, RosParameterType::kBoolArray,
              RosParameterType::kIntegerArray, RosParameterType::kDoubleArray, RosParameterType::kStringArray>();
}
inline void Describe(TypeBuilder<RosParameterValue>& type) {
  type.Name("ros.ParameterValue")
      .Fields<&RosParameterValue::type, &RosParameterValue::bool_value, &RosParameterValue::integer_value,
              &RosParameterValue::double_value, &RosParameterValue::string_value, &RosParameterValue::byte_array_value,
              &RosParameterValue::bool_array_value, &RosParameterValue::integer_array_value,
              &RosParameterValue::double_array_value, &RosParameterValue::string_array_value>();
}
inline void Describe(TypeBuilder<RosParameter>& type) {
  type.Name("ros.Parameter").Fields<&RosParameter::name, &RosParameter::value>();
}
inline void Describe(TypeBuilder<RosFloatRange>& type) {
  type.Name("ros.FloatingPointRange")
      .Fields<&RosFloatRange::from_value, &RosFloatRange::to_value, &RosFloatRange::step>();
}
inline void Describe(TypeBuilder<RosIntegerRange>& type) {
  type.Name("ros.IntegerRange")
      .Fields<&RosIntegerRange::from_value, &RosIntegerRange::to_value, &RosIntegerRange::step>();
}
inline void Describe(TypeBuilder<RosParameterDescriptor>& type) {
  type.Name("ros.ParameterDescriptor")
      .Fields<&RosParameterDescriptor::name, &RosParameterDescriptor::type, &RosParameterDescriptor::description,
              &RosParameterDescriptor::additional_constraints, &RosParameterDescriptor::read_only,
              &RosParameterDescriptor::dynamic_typing, &RosParameterDescriptor::floating_point_range,
              &RosParameterDescriptor::integer_range>();
}
inline void Describe(TypeBuilder<RosSetResult>& type) {
  type.Name("ros.SetParametersResult").Fields<&RosSetResult::successful, &RosSetResult::reason>();
}
inline void Describe(TypeBuilder<RosListRequest>& type) {
  type.Name("ros.ListParameters_Request").Fields<&RosListRequest::prefixes, &RosListRequest::depth>();
}
inline void Describe(TypeBuilder<RosListReply>& type) {
  type.Name("ros.ListParametersResult").Fields<&RosListReply::names, &RosListReply::prefixes>();
}
inline void Describe(TypeBuilder<RosParameterEvent>& type) {
  type.Name("ros.ParameterEvent")
      .Fields<&RosParameterEvent::stamp, &RosParameterEvent::node, &RosParameterEvent::new_parameters,
              &RosParameterEvent::changed_parameters, &RosParameterEvent::deleted_parameters>();
}

}  // namespace runnel
