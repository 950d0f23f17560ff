#pragma once

#include <string>

#include "modules/simulation/algorithm/world.h"

namespace runnel {

/// The world as XML in the format that ReadWorld reads. Numbers are as short as they can be without
/// losing a bit, so that reading gives an equal world. Headings of 0 and heights of 1 are left out.
[[nodiscard]] std::string WriteWorld(const World& world);

}  // namespace runnel
