#include <algorithm>

#include "bench/report/chart_axis.h"
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

struct Plot {
  ChartAxis x;
  ChartAxis y;
  [[nodiscard]] Svg::Point At(double position, double value) const {
    return {kLeft + x.Share(position) * kPlotWidth, kTop + (1 - y.Share(value)) * kPlotHeight};
  }
};

void DrawGrid(Svg& svg, const Plot& plot, const Workload& workload, const Quantity& quantity) {
  const double bottom = kTop + kPlotHeight;
  for (const double tick : plot.x.Ticks()) {
    const double x = kLeft + plot.x.Share(tick) * kPlotWidth;
    svg.Line({x, kTop}, {x, bottom}, kGrid);
    svg.Text({x, bottom + 18}, Short(tick), Svg::Anchor::kMiddle, 11, kQuiet);
  }
  for (const double tick : plot.y.Ticks()) {
    const double y = kTop + (1 - plot.y.Share(tick)) * kPlotHeight;
    svg.Line({kLeft, y}, {kLeft + kPlotWidth, y}, kGrid);
    svg.Text({kLeft - 6, y + 4}, ShortWithUnit(tick, quantity.unit), Svg::Anchor::kEnd, 11, kQuiet);
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
