#pragma once

#include "core/element/framework_element.h"
#include "core/port/port.h"

namespace runnel {

/// The parameter that is set by what comes at `port` (Configurable::Feed()); nullptr: it is any other port.
[[nodiscard]] inline const FrameworkElement* ParameterSetBy(const Port& port) {
  const FrameworkElement* const parameter = port.parent()->parent();
  return parameter != nullptr && parameter->kind() == ElementKind::kParameter ? parameter : nullptr;
}

/// An input that sets a parameter comes and goes with its connections: it has no value, mark, block, limits or tags of
/// its own. Errors: `port` is one.
[[nodiscard]] inline Result<void> CheckMayBeSet(const Port& port) {
  const FrameworkElement* const parameter = ParameterSetBy(port);
  if (parameter == nullptr) return {};
  return Error{.message = "only passes on what is connected to the parameter " + parameter->path() +
                          ": it has no value, mark, block, limits or tags of its own",
               .path = port.path(),
               .hint = "set the parameter, or say it of the output that is connected to it"};
}

}  // namespace runnel
