#pragma once

#include <optional>

#include "modules/behaviours/algorithm/curve.h"
#include "plugins/behaviours/behaviour.h"
#include "plugins/parameters/input_timeout.h"

namespace runnel {

inline void Describe(TypeBuilder<CurveKind>& type) {
  type.Name("CurveKind").Values<CurveKind::kRise, CurveKind::kFall, CurveKind::kRiseFall, CurveKind::kFallRise>();
}
inline void Describe(TypeBuilder<CurveShape>& type) {
  type.Name("CurveShape").Values<CurveShape::kSine, CurveShape::kLinear>();
}

/// Makes an activity of a number, by a curve: how what is no behaviour, a distance, a charge, stimulates and inhibits
/// some. Activity = curve * activation, target rating = curve.
class NumberToActivity final : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Input<double> number{this, "number", Measured("what becomes an activity")};
  InputTimeout number_timeout{this, number, {}};
  Parameter<CurveKind> curve{
      this, "curve", {.default_value = Curve{}.kind, .description = "which way it goes, first and then"}};
  Parameter<CurveShape> shape{this, "shape", {.default_value = Curve{}.shape, .description = "how it bends"}};
  Parameter<double> start{this, "start", {.default_value = Curve{}.start, .description = "where it begins to"}};
  Parameter<double> end{this, "end", {.default_value = Curve{}.end, .description = "where it has"}};
  Parameter<double> second_start{
      this,
      "second_start",
      {.default_value = Curve{}.second_start, .description = "where it begins to go back (rise_fall, fall_rise)"}};
  Parameter<double> second_end{
      this, "second_end", {.default_value = Curve{}.second_end, .description = "where it is back"}};

 private:
  std::optional<Outcome> Behave(double activation) override {
    const auto value = number_timeout.Read(number, now());
    if (!value) return Miss(number_timeout.words());
    const Curve shown{curve.Get(), shape.Get(), start.Get(), end.Get(), second_start.Get(), second_end.Get()};
    if (!IsOrdered(shown)) return Miss("start, end, second_start and second_end are not in their order");
    const double part = ValueAt(shown, *value);
    return Outcome{part * activation, part};
  }
};

}  // namespace runnel
