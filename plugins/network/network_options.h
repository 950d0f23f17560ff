#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "plugins/ros_services/offered_service.h"
#include "plugins/ros_services/ros_node.h"
#include "plugins/wire/wire.h"

namespace runnel {

class MessageLibrary;

/// How values of one port are kept and sent, as files name it.
enum class ValueQuality {
  kNewest,   ///< reliable, the newest value; what a slow reader misses is gone
  kEach,     ///< reliable, each value in its order, as long as a queue has room
  kSensor,   ///< best effort, the newest 5
  kLatched,  ///< reliable, and who comes late gets the newest
};

[[nodiscard]] inline WireQos QosOf(ValueQuality quality) {
  // By ValueQuality.
  constexpr std::array<WireQos, 4> kQos{{{}, {.depth = 128}, {.is_reliable = false, .depth = 5}, {.is_latched = true}}};
  return kQos[static_cast<std::size_t>(quality)];
}

/// Which thread makes octets of values and hands them to the engine.
enum class ValueSending {
  kNetwork,     ///< the network's, which is woken
  kAfterCycle,  ///< of small ones that whose cycle they have been published in, when it has ended; not with a rate
};

/// A port, or ports, that others may read.
struct OfferOptions {
  std::vector<std::string> patterns = {};  ///< of ports (PortPatterns), or
  std::string port = {};                   ///< one, by its path from the root
  std::string topic = {};                  ///< "/scan"; "": follows from the path
  std::string as = {};                     ///< type of the messages; "": by the description of the port's type
  std::string frame = {};                  ///< of coordinates, for headers
  std::string child_frame = {};            ///< what moves, of transforms and odometry
  ValueQuality quality = ValueQuality::kNewest;
  ValueSending sending = ValueSending::kNetwork;
  double rate = 0;                            ///< most values a second; 0: no bound
  std::string unit = {};                      ///< of the port, told to others
  std::optional<std::int32_t> strength = {};  ///< the only one that counts, if no stronger one is there
  bool is_measured = false;                   ///< a velocity that is no command: it goes on in STOP
  SourcePosition position = {};

  bool operator==(const OfferOptions&) const = default;
};

/// All that others may read and call.
struct Offered {
  std::vector<OfferOptions> ports = {};
  std::vector<ServiceOfferOptions> services = {};

  bool operator==(const Offered&) const = default;
};

/// What was offered before and after something was called `to` instead of `from`. As long as it is just that, calling it `from`
/// again restores it: something else that is gone may have been offered by the name.
struct OfferRenaming {
  std::string from;
  std::string to;
  Offered before;
  Offered after;
};

/// A topic whose values go to ports of this application.
struct TakeOptions {
  std::string topic = {};
  std::string as = {};
  std::string field = {};                    ///< of the message, of which alone the values are made: "ranges[0]"
  std::optional<ValueQuality> quality = {};  ///< nothing: as much as all writers offer
  bool is_exclusive = false;                 ///< of several writers only the strongest counts
  bool keeps_stamps = false;                 ///< values are as old as their writer says, by synchronised clocks
  bool is_distant = false;                   ///< comes of a connection from "//…"
  bool is_live = false;                      ///< also with simulated time, whose runs then are not repeatable
  SourcePosition position = {};

  bool operator==(const TakeOptions&) const = default;
};

/// What <network> says.
struct NetworkOptions {
  WireMemberOptions member = {};
  std::string engine = "cyclone";
  bool is_live = false;  ///< TakeOptions::is_live of all
  std::vector<OfferOptions> offers = {};
  std::vector<ServiceOfferOptions> services = {};
  std::vector<std::string> commands = {};               ///< set, swap: that others may ask for
  std::shared_ptr<const MessageLibrary> messages = {};  ///< nullptr: those of ROS 2
  std::optional<RosOptions> ros = {};
  SourcePosition position = {};
};

}  // namespace runnel
