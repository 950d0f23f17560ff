#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/types/type_info.h"

namespace runnel::internal {

inline constexpr std::string_view kGridMessage = "nav_msgs/msg/OccupancyGrid";

/// Whether the type has the fields of the meaning `world_map` that a grid is made of.
[[nodiscard]] bool CanBecomeGrid(const TypeInfo& type);

/// Sets `octets` to the ground plan as nav_msgs/msg/OccupancyGrid: 100 within obstacles and on their outlines, 0 where
/// nothing is, -1 beyond the bounds. Cells have 5 cm, or more where a side would have more than 2000 of them.
/// Precondition: CanBecomeGrid(). Allocates.
void WriteGrid(const TypeInfo& type, const void* map, Time stamp, const std::string& frame,
               std::vector<std::byte>& octets);

}  // namespace runnel::internal
