#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "modules/simulation/algorithm/world.h"

namespace runnel {

enum class WorldKind {
  kScatter,  ///< shapes of all kinds strewn over the ground
  kMaze,     ///< cells of a grid, joined by one way each, and by a few more
  kSpiral,   ///< the goal in the middle of a square spiral
  kComb,     ///< a comb whose teeth stand across the straight line
  kRing,     ///< shapes of all kinds in rings round the start and round the goal
};
inline constexpr std::array kWorldKindNames{"scatter", "maze", "spiral", "comb", "ring"};

struct GeneratorOptions {
  WorldKind kind = WorldKind::kScatter;
  std::uint64_t seed = 1;
  double width = 16.0;   ///< m along x, of the ground of a scatter or a maze; of rings twice the way to the goal
  double height = 12.0;  ///< m along y
  double gap = 1.0;      ///< m, of every passage at least
  /// Shapes of a scatter (fewer if there is no room), teeth of a comb, turns of a spiral, rings round the start and
  /// round the goal; 0: the seed decides.
  int count = 0;
  bool is_enclosed = false;  ///< a wall without a door stands round the goal

  friend bool operator==(const GeneratorOptions&, const GeneratorOptions&) = default;
};

/// What the options must keep to.
inline constexpr double kLeastGap = 0.7;  ///< m: a body of 0.3 m with 0.2 m on either side
inline constexpr double kGreatestGap = 5.0;
inline constexpr double kLeastGround = 8.0;  ///< m; and at least five gaps
inline constexpr double kGreatestGround = 200.0;
inline constexpr int kGreatestCount = 200;

/// What is wrong with the options, in one sentence; empty if nothing is.
[[nodiscard]] std::string FaultOf(const GeneratorOptions& options);

/// A world made of random numbers: the same options, the same world, to the bit. It has no faults
/// (FaultsOf), start and goal have half a gap round them, all coordinates are whole millimetres, and
/// the goal can be reached unless it is enclosed. A gap is the distance between two obstacles, or
/// between two parts of one that face each other.
///
/// Precondition: the options have no fault.
[[nodiscard]] World GenerateWorld(const GeneratorOptions& options);

}  // namespace runnel
