#pragma once

#include "core/element/framework_element.h"

namespace runnel {

/// One face of a module: the element under which its inputs, or its outputs, hang.
class PortGroup final : public FrameworkElement {
 public:
  explicit PortGroup(const Placement& placement)
      : FrameworkElement(placement, ElementKind::kPortGroup) {}
};

}  // namespace runnel
