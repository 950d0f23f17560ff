#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plugins/values/internal/message_parts.h"

namespace runnel::internal {

/// Cuts a closed line into triangles of its corners, by their numbers; heights do not count. Of a line
/// that crosses itself some parts may be left out; lines of more than `most` corners are not cut at all,
/// since the time grows with the square of their number. (Meisters, "Polygons have ears", 1975.)
[[nodiscard]] std::vector<std::array<std::size_t, 3>> TrianglesOf(const std::vector<Place>& ring,
                                                                  std::size_t most = 400);

}  // namespace runnel::internal
