#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// What a reader or writer of a topic asks of DDS, as far as ROS 2 speaks of it. Liveliness is always automatic, and
/// history never keeps all but in readers of ros_discovery_info: a publisher shall not wait for a reader.
struct Quality {
  bool is_reliable = true;
  bool is_transient_local = false;  ///< who comes late gets what was kept
  std::uint32_t depth = 10;         ///< how many values are kept
  bool keeps_all = false;
  Duration lifespan = Duration::max();

  friend bool operator==(const Quality&, const Quality&) = default;
};

/// The profiles of ROS 2, and those of `<offer qos="…">`: default, services, sensor, parameters, parameter_events, rosout,
/// latched, clock, discovery_writer, discovery_reader, newest, each.
/// Errors: there is none of that name, with the nearest.
[[nodiscard]] Result<Quality> FindQuality(std::string_view name);

/// Why a reader gets nothing from a writer, in words; "" if it does.
[[nodiscard]] std::string WhyNoMatch(const Quality& writer, const Quality& reader);

}  // namespace runnel
