#pragma once

#include <cmath>

#include "modules/simulation/algorithm/random.h"
#include "modules/types/algorithm/angle.h"
#include "modules/worlds/algorithm/world_generator.h"

namespace runnel::internal {

[[nodiscard]] World MakeScatter(const GeneratorOptions& options, Random& random);
[[nodiscard]] World MakeMaze(const GeneratorOptions& options, Random& random);
[[nodiscard]] World MakeSpiral(const GeneratorOptions& options, Random& random);
[[nodiscard]] World MakeComb(const GeneratorOptions& options, Random& random);
[[nodiscard]] World MakeRing(const GeneratorOptions& options, Random& random);

/// To whole millimetres, so that files can be read and no arithmetic shows in them.
[[nodiscard]] inline double Rounded(double length) { return std::round(length * 1000.0) / 1000.0 + 0.0; }
[[nodiscard]] inline Point2 Rounded(Point2 point) { return {Rounded(point.x), Rounded(point.y)}; }

/// By which gaps are made wider, since rounding may take it away again.
inline constexpr double kRoundingMargin = 0.003;  // m

}  // namespace runnel::internal
