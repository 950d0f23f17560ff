#pragma once

namespace runnel {

/// How a number becomes an activity.
enum class CurveKind {
  kRise,      ///< 0 up to `start`, 1 from `end` on
  kFall,      ///< 1 up to `start`, 0 from `end` on
  kRiseFall,  ///< rises from `start` to `end`, falls from `second_start` to `second_end`
  kFallRise,  ///< the other way round
};
enum class CurveShape {
  kSine,  ///< 1/2 + 1/2 sin(pi ((x - start) / (end - start) - 1/2))
  kLinear,
};

/// start < end <= second_start < second_end; the second two count for kRiseFall and kFallRise only.
struct Curve {
  CurveKind kind = CurveKind::kRise;
  CurveShape shape = CurveShape::kSine;
  double start = 0.0;
  double end = 1.0;
  double second_start = 1.0;
  double second_end = 2.0;
};

/// Whether the four stand in their order.
[[nodiscard]] bool IsOrdered(const Curve& curve);
/// Within [0, 1]. Precondition: IsOrdered().
[[nodiscard]] double ValueAt(const Curve& curve, double x);

}  // namespace runnel
