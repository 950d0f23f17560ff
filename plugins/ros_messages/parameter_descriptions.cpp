#include "core/types/type_of.h"
#include "plugins/ros_messages/parameter_messages.h"

namespace runnel {

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
