#pragma once

namespace runnel {

/// Whether an interface besides the loopback's has an address now, so that there is somebody to be reached. Calls the system.
[[nodiscard]] bool IsInNetwork();

}  // namespace runnel
