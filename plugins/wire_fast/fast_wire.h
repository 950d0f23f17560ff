#pragma once

#include <memory>

#include "plugins/wire/wire.h"

namespace runnel {

/// eProsima Fast DDS, which speaks DDSI-RTPS as ROS 2's default middleware does.
[[nodiscard]] std::shared_ptr<WireEngine> MakeFastWire();

}  // namespace runnel
