#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "plugins/wire/wire.h"

namespace runnel {

/// Which call a request or a reply belongs to: who calls, and its how manyth call it is.
struct CallId {
  WireId client = {};  ///< of rmw_cyclonedds only the first eight octets
  std::int64_t number = 0;

  friend bool operator==(const CallId&, const CallId&) = default;
};

/// A request or a reply: which one, and the message as it is without that.
struct ServiceMessage {
  CallId id;
  Octets message;
  std::uint64_t writer = 0;  ///< WireEndpoint::handle
};

/// As rmw_cyclonedds has it: the call stands in front of the message. `message`: with the encapsulation, of this machine's order
/// of octets.
[[nodiscard]] Octets WithCallId(const CallId& id, std::span<const std::byte> message);
/// Nothing if the octets, which may be anything, are too short.
[[nodiscard]] std::optional<ServiceMessage> SplitCallId(std::span<const std::byte> octets);

}  // namespace runnel
