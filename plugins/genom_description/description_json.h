#pragma once

#include <string>

#include "plugins/genom_description/description.h"

namespace runnel::genom {

/// The whole description as JSON: types with their layout, interfaces, components with ports, tasks, services, codels and
/// what these exclude. What each field is, says the README.
[[nodiscard]] std::string DescriptionJson(const Description& description);

}  // namespace runnel::genom
