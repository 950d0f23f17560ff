#include "modules/planning/algorithm/direction_choice.h"

#include <cmath>

namespace runnel {

namespace {

constexpr double kHeadOn = DegreesToRadians(5.0);  // rad; both turns are the same

}  // namespace

BoundaryDirection LocalDirection::Choose(const BugView& view, double contact_bearing) const {
  if (view.state.node_side) return *view.state.node_side;
  const double bearing = WrapAngle(contact_bearing);
  if (std::abs(bearing) < kHeadOn) return view.configuration.first_direction;
  return bearing > 0.0 ? BoundaryDirection::kRight : BoundaryDirection::kLeft;
}

BoundaryDirection AlternateDirection::Choose(const BugView& view, double) const {
  return view.state.last_direction ? Opposite(*view.state.last_direction)
                                   : view.configuration.first_direction;
}

}  // namespace runnel
