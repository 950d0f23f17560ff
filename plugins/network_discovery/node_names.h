#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "plugins/wire/wire.h"

namespace runnel {

/// On which each member of ROS 2 tells of its nodes.
inline constexpr const char* kNodesTopic = "ros_discovery_info";
inline constexpr const char* kNodesType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

struct NodesOfMember {
  WireId member = {};
  std::string names = {};  ///< "/base, /arm": Printable()
};
/// What a member tells, in the layout of up to Humble (ids of 24 octets) or of from Iron on. Nothing: it is not that.
[[nodiscard]] std::optional<NodesOfMember> ReadNodes(std::span<const std::byte> octets);

}  // namespace runnel
