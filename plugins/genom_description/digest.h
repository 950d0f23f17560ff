#pragma once

#include <string>

#include "plugins/genom_description/component.h"

namespace runnel::genom {

/// Sixteen hexadecimal digits that change when what others see of the component changes: ports with their types,
/// services with parameters and exceptions. Comments, codels and defaults change nothing.
[[nodiscard]] std::string DigestOf(const Component& component);

}  // namespace runnel::genom
