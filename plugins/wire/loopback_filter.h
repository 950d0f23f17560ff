#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace runnel {

/// Has the sockets of this process that Cyclone has opened for a domain take datagrams of this machine's loopback addresses
/// only: Cyclone binds them to all interfaces, whichever it is told to use, so that anybody in the network could send to them.
/// Errors: the system does not do it.
Result<void> KeepToLoopback(std::uint32_t domain);

}  // namespace runnel
