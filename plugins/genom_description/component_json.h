#pragma once

#include <map>

#include <nlohmann/json.hpp>

#include "plugins/genom_description/component.h"

namespace runnel::genom {

using Json = nlohmann::ordered_json;

/// How much memory a value takes as codels in C see it, on 64 bits.
struct Layout {
  std::uint64_t size = 0;
  std::uint64_t alignment = 1;
};

/// Computes layouts, each once. Sizes that 64 bits do not hold are the largest that they do.
class Layouts {
 public:
  [[nodiscard]] Layout Of(const Type& type);
  /// Of what stands side by side: where each member begins is added to `offsets`.
  [[nodiscard]] Layout OfMembers(const std::vector<Type*>& members, std::vector<std::uint64_t>* offsets = nullptr);

 private:
  static constexpr int kDeepest = 1000;
  [[nodiscard]] Layout Compute(const Type& type);
  std::map<const Type*, Layout> known_ = {};
  int depth_ = 0;
};

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
