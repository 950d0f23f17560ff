#pragma once

#include <memory>
#include <vector>

#include "core/element/framework_element.h"

namespace runnel {

/// A composite: modules and other groups that serve one purpose, behind an interface of ports of
/// its own (ProxyPort, made below the group). What is inside can be exchanged without the outside
/// knowing.
///
/// Written in C++, a composite derives from it: what never varies are members, what follows from static
/// parameters is made in Construct(); both as for modules, and it is registered as they are.
class Group : public FrameworkElement {
 public:
  explicit Group(const Placement& placement) : FrameworkElement(placement, ElementKind::kGroup) {}
};

/// One face of a module: the element under which its inputs, or its outputs, hang.
class PortGroup final : public FrameworkElement {
 public:
  explicit PortGroup(const Placement& placement) : FrameworkElement(placement, ElementKind::kPortGroup) {}
};

/// `group` as a task names it: nothing, if no port has asked for the group.
[[nodiscard]] inline std::vector<const FrameworkElement*> AsTaskGroups(const std::unique_ptr<PortGroup>& group) {
  if (!group) return {};
  return {group.get()};
}

}  // namespace runnel
