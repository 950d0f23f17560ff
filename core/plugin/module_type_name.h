#pragma once

#include <string>
#include <utility>

#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// Kept with every module that was made by its type: what a file has to say to get the same again.
struct ModuleTypeName final : Annotation {
  explicit ModuleTypeName(std::string type_name) : name(std::move(type_name)) {}
  std::string name;
};

/// "" if the module was made by C++ code that named its class.
[[nodiscard]] inline std::string FindModuleType(const FrameworkElement& module) {
  const auto* const type = module.FindAnnotation<ModuleTypeName>();
  return type != nullptr ? type->name : "";
}

/// Whether people see it as one module: also a group that is made by a type of its own.
[[nodiscard]] inline bool IsModule(const FrameworkElement& element) {
  return element.kind() == ElementKind::kModule || !FindModuleType(element).empty();
}

/// The outermost module that `element` is, or is part of; nullptr if there is none.
[[nodiscard]] inline const FrameworkElement* FindModuleAround(const FrameworkElement& element) {
  const FrameworkElement* module = nullptr;
  for (const FrameworkElement* at = &element; at != nullptr; at = at->parent()) {
    if (IsModule(*at)) module = at;
  }
  return module;
}

/// The module or group that a port or parameter belongs to; nullptr if there is none.
[[nodiscard]] inline const FrameworkElement* FindOwner(const FrameworkElement& element) {
  const FrameworkElement* at = element.parent();
  while (at != nullptr && !IsModule(*at) && at->kind() != ElementKind::kGroup) at = at->parent();
  return at;
}

}  // namespace runnel
