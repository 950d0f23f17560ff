#pragma once

#include <vector>

namespace runnel::bench {

/// One axis of a chart: logarithmic if the values differ much and none is 0, else linear from 0.
class ChartAxis {
 public:
  /// First all values, then Finish(), then the rest.
  void Include(double value);
  void Finish();

  /// 0 at the low end, 1 at the high one.
  [[nodiscard]] double Share(double value) const;
  [[nodiscard]] std::vector<double> Ticks() const;

 private:
  void FinishLinear();

  double low_ = 1e300;
  double high_ = 0;
  bool is_logarithmic_ = false;
  double bottom_ = 0;  // of logarithms, if it is logarithmic
  double top_ = 1;
  double step_ = 1;
};

}  // namespace runnel::bench
