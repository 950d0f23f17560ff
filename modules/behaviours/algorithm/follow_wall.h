#pragma once

#include "modules/behaviours/algorithm/drive_to_goal.h"

namespace runnel {

/// Which way it turns where it meets a wall, which is then on its other hand.
enum class FirstTurn { kLeft, kRight };

struct FollowWallConfiguration {
  FirstTurn first_turn = FirstTurn::kLeft;
  double look_ahead = 0.5;  ///< m; a way that is free so far is a way
};

/// Along the wall on its hand: from there, swings the gaze round to the first way that is free. Where there is no wall
/// it turns to where one should be. Its rating: how far it is from driving beside a wall.
[[nodiscard]] Wish FollowWall(const SteeringConfiguration& steering, const FollowWallConfiguration& configuration,
                              const Surroundings& surroundings);

}  // namespace runnel
