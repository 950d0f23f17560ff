#pragma once

#include <functional>
#include <string>

#include "core/base/result.h"
#include "plugins/wire/wire.h"

struct sockaddr;

namespace runnel {

/// Whether there is anybody whom the member is not to hear.
[[nodiscard]] inline bool HasBoundedReach(const WireMemberOptions& options) {
  return options.reach != WireReach::kNetwork || !options.interface.empty();
}

/// Calls `open`, which has an engine open sockets for the member, and has those take only what comes from where the member
/// reaches: with kLoopback, of this machine's loopback addresses; with kMachine, of this machine; with an interface, by that,
/// or of this machine. Engines bind to all interfaces, or are in a group that the system has joined on another one, so that
/// others could send to them, whatever they are told to use. What had come before is out of the sockets when it returns: until
/// then an engine is not to listen. Sockets that were there before stay as they are, of whomever they are; one that another
/// thread opens meanwhile at a port of the domain is not told from the engine's. Errors: there is no such interface; the
/// system does not do it.
Result<void> KeepWithinReach(const WireMemberOptions& options, const std::function<void()>& open);

/// "192.168.1.5" of an IPv4 address.
[[nodiscard]] std::string AddressText(const sockaddr& address);

/// Whether an interface besides the loopback's has an address now, so that there is somebody to be reached. Calls the system.
[[nodiscard]] bool IsInNetwork();

/// "192.168.1.5" of an interface that is said by its name or its address. Errors: there is none; the hint says which there are.
[[nodiscard]] Result<std::string> AddressOfInterface(const std::string& interface);

}  // namespace runnel
