#pragma once

#include <cstdint>
#include <span>
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

enum class DirectionKind : std::uint8_t {
  kLeft,   ///< always
  kRight,  ///< always
  /// The side of the tangent node steered at last; if there was none, the side that turns least; if
  /// both are the same, the first direction configured.
  kLocal,
  /// Opposite to the one at the hit point before; the first direction configured at the first.
  kAlternate,
};
/// By kind.
[[nodiscard]] std::span<const DirectionChoice* const> AllDirections();

}  // namespace runnel
