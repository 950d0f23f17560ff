#pragma once

#include <memory>

#include "plugins/wire/wire.h"

namespace runnel {

/// An engine that sends by `engine`, but for large values that only processes of this machine and user read: those lie in
/// memory that all of them have, and `engine` tells where. Who does not know of it, as nodes of ROS 2, is sent the octets.
[[nodiscard]] std::shared_ptr<WireEngine> MakeSharedMemoryWire(std::shared_ptr<WireEngine> engine);

/// From so many octets on values are large: what fits into one datagram is sent as fast.
inline constexpr std::size_t kLargeValue = 32 * 1024;

}  // namespace runnel
