#pragma once

#include <nlohmann/json.hpp>

#include "plugins/genom_description/component.h"
#include "plugins/genom_description/layout.h"

namespace runnel::genom {

using Json = nlohmann::ordered_json;

/// The parts of a description as JSON. Private to the library.
class JsonWriter {
 public:
  JsonWriter(const Problems& problems, Layouts& layouts) : problems_(problems), layouts_(layouts) {}

  /// Whether it has an entry of its own among the types: members and events stand within others.
  [[nodiscard]] static bool IsDeclared(const Type& type);
  [[nodiscard]] Json Declared(const Type& type) const;
  [[nodiscard]] Json ComponentJson(const Component& component) const;

 private:
  [[nodiscard]] Json PlaceJson(Place place) const;
  [[nodiscard]] Json Reference(const Type* type) const;
  [[nodiscard]] Json Members(const Type& type) const;
  [[nodiscard]] Json ConstantJson(const Constant& value) const;
  [[nodiscard]] Json InitialJson(const Initializer& initial) const;
  [[nodiscard]] Json ParameterJson(const Parameter& parameter) const;
  [[nodiscard]] Json Parameters(const std::vector<Parameter>& parameters, bool are_variables) const;
  [[nodiscard]] Json Exceptions(std::initializer_list<const Properties*> properties) const;
  [[nodiscard]] Json TaskJson(const Task& task) const;
  [[nodiscard]] Json PortJson(const Port& port) const;
  [[nodiscard]] Json ServiceJson(const Service& service) const;
  [[nodiscard]] Json CodelJson(const Codel& codel) const;

  const Problems& problems_;
  Layouts& layouts_;
};

}  // namespace runnel::genom
