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

bool HasTwo(const Curve& curve) { return curve.kind == CurveKind::kRiseFall || curve.kind == CurveKind::kFallRise; }

}  // namespace

bool IsOrdered(const Curve& curve) {
  if (!(curve.start < curve.end)) return false;
  return !HasTwo(curve) || (curve.end <= curve.second_start && curve.second_start < curve.second_end);
}

double ValueAt(const Curve& curve, double x) {
  const double first = Rise(curve.shape, curve.start, curve.end, x);
  const double second = HasTwo(curve) ? Rise(curve.shape, curve.second_start, curve.second_end, x) : 0.0;
  const bool falls = curve.kind == CurveKind::kFall || curve.kind == CurveKind::kFallRise;
  return falls ? 1.0 - first + second : first - second;
}

}  // namespace runnel
