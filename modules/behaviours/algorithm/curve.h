#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

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
[[nodiscard]] inline bool IsOrdered(const Curve& curve) {
  if (!(curve.start < curve.end)) return false;
  const bool has_two = curve.kind == CurveKind::kRiseFall || curve.kind == CurveKind::kFallRise;
  return !has_two || (curve.end <= curve.second_start && curve.second_start < curve.second_end);
}

/// Within [0, 1]. Precondition: IsOrdered().
[[nodiscard]] inline double ValueAt(const Curve& curve, double x) {
  const auto rise = [&](double start, double end) {
    const double part = std::clamp((x - start) / (end - start), 0.0, 1.0);
    if (curve.shape == CurveShape::kLinear) return part;
    return std::clamp(0.5 + 0.5 * std::sin(std::numbers::pi * (part - 0.5)), 0.0, 1.0);
  };
  const double first = rise(curve.start, curve.end);
  switch (curve.kind) {
    case CurveKind::kRise:
      return first;
    case CurveKind::kFall:
      return 1.0 - first;
    case CurveKind::kRiseFall:
      return first - rise(curve.second_start, curve.second_end);
    case CurveKind::kFallRise:
      return 1.0 - first + rise(curve.second_start, curve.second_end);
  }
  return 0.0;
}

}  // namespace runnel
