#pragma once

#include <string>

#include "core/port/input.h"
#include "core/port/output.h"
#include "core/paths/path_search.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel::internal {

/// What somebody who asks for a T expects at a path, and what it is called in errors.
template <typename T>
struct FoundKind {
  static constexpr PathKind kKind = PathKind::kElement;
  static std::string Name() { return "what was asked for"; }
};
template <typename T>
struct FoundKind<Output<T>> {
  static constexpr PathKind kKind = PathKind::kOutput;
  static std::string Name() { return "an output of type " + TypeOf<T>().name(); }
};
template <typename T>
struct FoundKind<Input<T>> {
  static constexpr PathKind kKind = PathKind::kInput;
  static std::string Name() { return "an input of type " + TypeOf<T>().name(); }
};
template <typename T>
struct FoundKind<Parameter<T>> {
  static constexpr PathKind kKind = PathKind::kParameter;
  static std::string Name() { return "a parameter of type " + TypeOf<T>().name(); }
};
template <typename T>
struct FoundKind<StaticParameter<T>> {
  static constexpr PathKind kKind = PathKind::kParameter;
  static std::string Name() { return "a static parameter of type " + TypeOf<T>().name(); }
};

}  // namespace runnel::internal
