#pragma once

#include <string>

#include "apps/arena/course.h"
#include "apps/arena/run_record.h"

namespace runnel::arena {

/// Where all paths and the world are, in m.
struct ViewBox {
  Point2 low;
  Point2 high;

  void Include(Point2 point, double reach = 0.0);
};
[[nodiscard]] ViewBox ViewBoxOf(const Course& course);

/// The world's obstacles, start, goal and shortest path, as a <symbol> of this id. Drawn in m, y up;
/// colours come from the classes of the page.
[[nodiscard]] std::string WorldSymbol(const std::string& id, const Course& course,
                                      const ViewBox& view);
/// One run over the world: an <svg> that uses the symbol.
[[nodiscard]] std::string RunDrawing(const std::string& world_id, const RunRecord& record,
                                     const ViewBox& view);

}  // namespace runnel::arena
