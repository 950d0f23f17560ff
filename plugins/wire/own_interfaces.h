#pragma once

#include <string>

#include "core/base/result.h"

struct sockaddr;

namespace runnel {

/// "192.168.1.5" of an IPv4 address.
[[nodiscard]] std::string AddressText(const sockaddr& address);

/// Whether an interface besides the loopback's has an address now, so that there is somebody to be reached. Calls the system.
[[nodiscard]] bool IsInNetwork();

/// "192.168.1.5" of an interface that is said by its name or its address. Errors: there is none; the hint says which there are.
[[nodiscard]] Result<std::string> AddressOfInterface(const std::string& interface);

}  // namespace runnel
