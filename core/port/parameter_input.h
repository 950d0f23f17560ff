#pragma once

#include "core/base/result.h"
#include "core/element/framework_element.h"

namespace runnel {

/// The parameter that is set by what comes at `port` (Configurable::Feed()); nullptr: it is something else.
[[nodiscard]] inline const FrameworkElement* ParameterSetBy(const FrameworkElement& port) {
  const FrameworkElement* const parameter = port.parent() != nullptr ? port.parent()->parent() : nullptr;
  return parameter != nullptr && parameter->kind() == ElementKind::kParameter ? parameter : nullptr;
}

/// An input that sets a parameter comes and goes with its connections: it has no value, mark, block, limits or tags of
/// its own. Errors: `port` is one.
[[nodiscard]] inline Result<void> CheckMayBeSet(const FrameworkElement& port) {
  const FrameworkElement* const parameter = ParameterSetBy(port);
  if (parameter == nullptr) return {};
  return Error{.message = "only passes on what is connected to the parameter " + parameter->path() +
                          ": it has no value, mark, block, limits or tags of its own",
               .path = port.path(),
               .hint = "set the parameter, or say it of the output that is connected to it"};
}

}  // namespace runnel
