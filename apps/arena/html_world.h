#pragma once

#include <string>

#include "apps/arena/course.h"
#include "apps/arena/run_record.h"
#include "modules/simulation/algorithm/outline.h"

namespace runnel::arena {

/// What is shown of a world, with some air round it.
[[nodiscard]] Extent ViewOf(const Course& course);

/// The world's obstacles, start, goal and shortest path, as a <symbol> of this id. Drawn in m, y up;
/// colours come from the classes of the page.
[[nodiscard]] std::string WorldSymbol(const std::string& id, const Course& course,
                                      const Extent& view);
/// One run over the world: an <svg> that uses the symbol.
[[nodiscard]] std::string RunDrawing(const std::string& world_id, const RunRecord& record,
                                     const Extent& view);

}  // namespace runnel::arena
