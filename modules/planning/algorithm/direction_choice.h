#pragma once

#include <string_view>

#include "modules/planning/algorithm/bug_view.h"

namespace runnel {

/// Component of a Bug algorithm: which way the robot turns at a hit point. Objects have no state;
/// they outlive the algorithms made of them.
class DirectionChoice {
 public:
  virtual ~DirectionChoice() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// `contact_bearing` (rad, body's frame) is that of the boundary point in the way.
  [[nodiscard]] virtual BoundaryDirection Choose(const BugView& view,
                                                 double contact_bearing) const = 0;
};

/// Always the same.
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

/// The side of the tangent node steered at last; if there was none, the side that turns least; if
/// both are the same, the first direction configured.
class LocalDirection final : public DirectionChoice {
 public:
  [[nodiscard]] std::string_view name() const override { return "local"; }
  [[nodiscard]] BoundaryDirection Choose(const BugView& view,
                                         double contact_bearing) const override;
};

/// Opposite to the one at the hit point before; the first direction configured at the first.
class AlternateDirection final : public DirectionChoice {
 public:
  [[nodiscard]] std::string_view name() const override { return "alternate"; }
  [[nodiscard]] BoundaryDirection Choose(const BugView& view, double) const override;
};

}  // namespace runnel
