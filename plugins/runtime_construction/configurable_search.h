#pragma once

#include <string>
#include <vector>

#include "core/element/configurable.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/path_use.h"

namespace runnel {

/// Something that can be set, as an element and as what sets it.
struct ConfigurableElement {
  FrameworkElement* element = nullptr;
  Configurable* configurable = nullptr;

  explicit operator bool() const noexcept { return configurable != nullptr; }
};

/// What can be set of a module: what is directly below it or in one of its groups.
[[nodiscard]] std::vector<ConfigurableElement> ConfigurablesOf(const FrameworkElement& module);

/// What a path names. "guard/speed" is short for "guard/parameter/speed". Empty after reporting
/// what is not there or cannot be set.
[[nodiscard]] ConfigurableElement SearchConfigurable(const PathUse& use, BuildContext& context);

}  // namespace runnel
