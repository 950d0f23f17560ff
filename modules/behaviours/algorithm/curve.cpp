#include "modules/behaviours/algorithm/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace runnel {

namespace {

double Rise(CurveShape shape, double start, double end, double x) {
  const double part = std::clamp((x - start) / (end - start), 0.0, 1.0);
  if (shape == CurveShape::kLinear) return part;
  return std::clamp(0.5 + 0.5 * std::sin(std::numbers::pi * (part - 0.5)), 0.0, 1.0);
}

}  // namespace

bool IsOrdered(const Curve& curve) {
  if (!(curve.start < curve.end)) return false;
  const bool has_two = curve.kind == CurveKind::kRiseFall || curve.kind == CurveKind::kFallRise;
  return !has_two || (curve.end <= curve.second_start && curve.second_start < curve.second_end);
}

double ValueAt(const Curve& curve, double x) {
  const double first = Rise(curve.shape, curve.start, curve.end, x);
  switch (curve.kind) {
    case CurveKind::kRise:
      return first;
    case CurveKind::kFall:
      return 1.0 - first;
    case CurveKind::kRiseFall:
      return first - Rise(curve.shape, curve.second_start, curve.second_end, x);
    case CurveKind::kFallRise:
      return 1.0 - first + Rise(curve.shape, curve.second_start, curve.second_end, x);
  }
  return 0.0;
}

}  // namespace runnel
