#include "modules/adaptors/algorithm/bumper_adaptor.h"

namespace runnel {

Surroundings BumperAdaptor::Update(const Contact& contact, const Pose2& pose) {
  Surroundings surroundings;
  surroundings.is_measured = true;
  surroundings.safe_distance = static_cast<float>(configuration_.safe_distance);
  map_.SetPose(pose);
  const double inside = configuration_.body_radius - configuration_.body_margin;
  map_.ForgetBoundaries([&](Point2 point) { return Distance(Position(pose), point) < inside; });
  // A switch that stays pressed after a touch goes on telling the old bearing, which is none any
  // more once the body has turned.
  if (contact.is_touching && contact != last_) {
    const Point2 local = configuration_.body_radius * UnitVector(contact.bearing);
    map_.MarkBoundary(ToWorld(pose, local));
  }
  last_ = contact;
  map_.AddBoundariesTo(surroundings);
  return surroundings;
}

}  // namespace runnel
