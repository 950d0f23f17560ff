#pragma once

#include <memory>
#include <vector>

#include "core/element/framework_element.h"

namespace runnel {

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
