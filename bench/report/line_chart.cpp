#include <algorithm>
#include <cmath>

#include "bench/report/chart_style.h"
#include "bench/report/charts.h"
#include "bench/report/svg.h"
#include "bench/report/text.h"

namespace runnel::bench {

namespace {

constexpr double kLeft = 80;
constexpr double kTop = 56;
constexpr double kPlotWidth = 440;
constexpr double kPlotHeight = 300;
constexpr double kLegend = 250;

/// One logarithmic axis; 0 is shown where a tenth of the smallest other value would be.
class LogAxis {
 public:
  void Include(double value) {
    if (value > 0) {
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    } else {
      has_zero_ = true;
    }
  }
  void Finish() {
    if (low_ > high_) low_ = high_ = 1;
    bottom_ = std::floor(std::log10(low_) + 1e-9) - (has_zero_ ? 1 : 0);
    top_ = std::max(std::ceil(std::log10(high_) - 1e-9), bottom_ + 1);
  }
  /// 0 at the low end, 1 at the high one.
  [[nodiscard]] double Share(double value) const {
    return value <= 0 ? 0 : (std::log10(value) - bottom_) / (top_ - bottom_);
  }
  [[nodiscard]] std::vector<double> Ticks() const {
    std::vector<double> ticks;
    for (double power = bottom_; power <= top_ + 1e-9; power += 1) {
      const bool is_zero = has_zero_ && power == bottom_;
      ticks.push_back(is_zero ? 0 : std::pow(10, power));
    }
    return ticks;
  }

 private:
  double low_ = 1e300;
  double high_ = 0;
  bool has_zero_ = false;
  double bottom_ = 0;
  double top_ = 1;
};

struct Plot {
  LogAxis x;
  LogAxis y;
  [[nodiscard]] Svg::Point At(double position, double value) const {
    return {kLeft + x.Share(position) * kPlotWidth, kTop + (1 - y.Share(value)) * kPlotHeight};
  }
};

void DrawGrid(Svg& svg, const Plot& plot, const Workload& workload, const Quantity& quantity) {
  const double bottom = kTop + kPlotHeight;
  for (const double tick : plot.x.Ticks()) {
    const double x = kLeft + plot.x.Share(tick) * kPlotWidth;
    svg.Line({x, kTop}, {x, bottom}, kGrid);
    svg.Text({x, bottom + 18}, Rounded(tick), Svg::Anchor::kMiddle, 11, kQuiet);
  }
  for (const double tick : plot.y.Ticks()) {
    const double y = kTop + (1 - plot.y.Share(tick)) * kPlotHeight;
    svg.Line({kLeft, y}, {kLeft + kPlotWidth, y}, kGrid);
    svg.Text({kLeft - 6, y + 4}, WithUnit(tick, quantity.unit), Svg::Anchor::kEnd, 11, kQuiet);
  }
  svg.Text({12, 22}, workload.family, Svg::Anchor::kStart, 16);
  svg.Text({12, 40}, TitleOf(quantity), Svg::Anchor::kStart, 12, kQuiet);
  svg.Text({kLeft + kPlotWidth / 2, bottom + 36}, workload.axis, Svg::Anchor::kMiddle);
}

}  // namespace

std::string LineChart(const std::vector<const Measurement*>& measurements) {
  Plot plot;
  std::vector<Subject> subjects;
  for (const Measurement* each : measurements) {
    plot.x.Include(each->workload.position);
    plot.y.Include(each->Typical());
    const bool is_known = std::ranges::any_of(
        subjects, [&](const Subject& subject) { return subject.name == each->subject.name; });
    if (!is_known) subjects.push_back(each->subject);
  }
  plot.x.Finish();
  plot.y.Finish();

  Svg svg(kLeft + kPlotWidth + kLegend, kTop + kPlotHeight + 50);
  DrawGrid(svg, plot, measurements.front()->workload, measurements.front()->quantity);
  double legend = kTop + 10;
  for (std::size_t number = 0; number < subjects.size(); ++number) {
    const Subject& subject = subjects[number];
    const bool is_own = subject.role == Role::kRunnel;
    const std::string colour = is_own ? kOwnColour : LineColour(number);
    std::vector<Svg::Point> points;
    for (const Measurement* each : measurements) {
      if (each->subject.name != subject.name) continue;
      points.push_back(plot.At(each->workload.position, each->Typical()));
    }
    svg.Polyline(points, colour, is_own ? 3 : 1.5);
    for (const Svg::Point& point : points) svg.Dot(point, is_own ? 4 : 2.5, colour);
    svg.Line({kLeft + kPlotWidth + 14, legend - 4}, {kLeft + kPlotWidth + 34, legend - 4}, colour,
             is_own ? 3 : 1.5);
    svg.Text({kLeft + kPlotWidth + 40, legend}, LabelOf(subject));
    legend += 20;
  }
  return svg.ToString();
}

}  // namespace runnel::bench
