#pragma once

namespace runnel {

/// What a bumper all round the body says.
struct Contact {
  bool is_touching = false;
  double bearing = 0.0;  ///< rad, of the point touched, in the body's frame; 0 while not touching

  friend constexpr bool operator==(const Contact&, const Contact&) = default;
};

}  // namespace runnel
