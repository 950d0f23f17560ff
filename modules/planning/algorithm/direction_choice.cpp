#include "modules/planning/algorithm/direction_choice.h"

#include <array>
#include <cmath>

namespace runnel {

namespace {

constexpr double kHeadOn = DegreesToRadians(5.0);  // rad; both turns are the same

class FixedDirection final : public DirectionChoice {
 public:
  explicit constexpr FixedDirection(BoundaryDirection direction) : direction_(direction) {}
  [[nodiscard]] std::string_view name() const override {
    return direction_ == BoundaryDirection::kLeft ? "left" : "right";
  }
  [[nodiscard]] BoundaryDirection Choose(const BugView&, double) const override {
    return direction_;
  }

 private:
  BoundaryDirection direction_;
};

class LocalDirection final : public DirectionChoice {
 public:
  [[nodiscard]] std::string_view name() const override { return "local"; }
  [[nodiscard]] BoundaryDirection Choose(const BugView& view,
                                         double contact_bearing) const override {
    if (view.state.node_side) return *view.state.node_side;
    const double bearing = WrapAngle(contact_bearing);
    if (std::abs(bearing) < kHeadOn) return view.configuration.first_direction;
    return bearing > 0.0 ? BoundaryDirection::kRight : BoundaryDirection::kLeft;
  }
};

class AlternateDirection final : public DirectionChoice {
 public:
  [[nodiscard]] std::string_view name() const override { return "alternate"; }
  [[nodiscard]] BoundaryDirection Choose(const BugView& view, double) const override {
    return view.state.last_direction ? Opposite(*view.state.last_direction)
                                     : view.configuration.first_direction;
  }
};

}  // namespace

std::span<const DirectionChoice* const> AllDirections() {
  static const FixedDirection left(BoundaryDirection::kLeft);
  static const FixedDirection right(BoundaryDirection::kRight);
  static const LocalDirection local;
  static const AlternateDirection alternate;
  static constexpr std::array<const DirectionChoice*, 4> all{&left, &right, &local, &alternate};
  return all;
}

}  // namespace runnel
