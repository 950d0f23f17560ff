#pragma once

#include <memory>

#include "plugins/wire/wire.h"

namespace runnel {

/// Eclipse Cyclone DDS, which speaks DDSI-RTPS as ROS 2 does.
[[nodiscard]] std::shared_ptr<WireEngine> MakeCycloneWire();

}  // namespace runnel
