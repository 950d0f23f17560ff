#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// Of a participant, a reader or a writer in DDS: 12 octets of the participant, 4 of the rest.
using RosGid = std::array<std::uint8_t, 16>;

/// What `ros2 node list` and `ros2 node info` show of a node.
struct RosNode {
  std::string name_space = "/";
  std::string name;
  std::vector<RosGid> readers;
  std::vector<RosGid> writers;

  friend bool operator==(const RosNode&, const RosNode&) = default;
};

/// One message of the topic "ros_discovery_info" (no "rt/" in front): all nodes of a
/// participant. Each participant has its own, and writes it anew at every change.
struct RosParticipant {
  RosGid gid{};
  std::vector<RosNode> nodes;

  friend bool operator==(const RosParticipant&, const RosParticipant&) = default;
};

/// A gid has 24 octets up to Humble and 16 from Iron on, under the same name of the type. Nodes of Humble run out of
/// memory when they read the other layout: write only when it is known who reads.
enum class RosGidLayout { kHumble, kIron };

/// By what ROS_DISTRO or a file says: "humble", "jazzy", … Errors: there is no such distribution, with the nearest name.
[[nodiscard]] Result<RosGidLayout> FindRosGidLayout(std::string_view distribution);

inline constexpr const char* kDiscoveryInfoTopic = "ros_discovery_info";
inline constexpr const char* kDiscoveryInfoType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// Threads: any. Allocates.
void WriteDiscoveryInfo(const RosParticipant& participant, RosGidLayout layout, std::vector<std::byte>& octets);

struct ReadParticipant {
  RosParticipant participant;
  RosGidLayout layout;  ///< in which it was written: what nodes of others understand
};
/// Errors: the octets, which may be anything, are no such message.
[[nodiscard]] Result<ReadParticipant> ReadDiscoveryInfo(std::span<const std::byte> octets);

}  // namespace runnel
