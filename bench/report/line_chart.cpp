#include <algorithm>

#include "bench/report/chart.h"
#include "bench/report/chart_axis.h"
#include "bench/report/chart_style.h"
#include "bench/report/charts.h"
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
  [[nodiscard]] Point2 At(double position, double value) const {
    return {kLeft + x.Share(position) * kPlotWidth, kTop + (1 - y.Share(value)) * kPlotHeight};
  }
};

void DrawGrid(Chart& chart, const Plot& plot, const Workload& workload, const Quantity& quantity) {
  const double bottom = kTop + kPlotHeight;
  for (const double tick : plot.x.Ticks()) {
    const double x = kLeft + plot.x.Share(tick) * kPlotWidth;
    chart.Polyline({{x, kTop}, {x, bottom}}, kGrid);
    chart.Text({x, bottom + 18}, Short(tick), Chart::Anchor::kMiddle, 11, kQuiet);
  }
  for (const double tick : plot.y.Ticks()) {
    const double y = kTop + (1 - plot.y.Share(tick)) * kPlotHeight;
    chart.Polyline({{kLeft, y}, {kLeft + kPlotWidth, y}}, kGrid);
    chart.Text({kLeft - 6, y + 4}, ShortWithUnit(tick, quantity.unit), Chart::Anchor::kEnd, 11, kQuiet);
  }
  chart.Text({12, 22}, workload.family, Chart::Anchor::kStart, 16);
  chart.Text({12, 40}, TitleOf(quantity), Chart::Anchor::kStart, 12, kQuiet);
  chart.Text({kLeft + kPlotWidth / 2, bottom + 36}, workload.axis, Chart::Anchor::kMiddle);
}

}  // namespace

std::string LineChart(const std::vector<const Measurement*>& measurements) {
  Plot plot;
  std::vector<Subject> subjects;
  for (const Measurement* each : measurements) {
    plot.x.Include(each->workload.position);
    plot.y.Include(each->Typical());
    const bool is_known =
        std::ranges::any_of(subjects, [&](const Subject& subject) { return subject.name == each->subject.name; });
    if (!is_known) subjects.push_back(each->subject);
  }
  plot.x.Finish();
  plot.y.Finish();

  Chart chart(kLeft + kPlotWidth + kLegend, kTop + kPlotHeight + 50);
  DrawGrid(chart, plot, measurements.front()->workload, measurements.front()->quantity);
  double legend = kTop + 10;
  for (std::size_t number = 0; number < subjects.size(); ++number) {
    const Subject& subject = subjects[number];
    const bool is_own = subject.role == Role::kRunnel;
    const std::string colour = is_own ? kOwnColour : LineColour(number);
    std::vector<Point2> points;
    for (const Measurement* each : measurements) {
      if (each->subject.name != subject.name) continue;
      points.push_back(plot.At(each->workload.position, each->Typical()));
    }
    chart.Polyline(points, colour, is_own ? 3 : 1.5);
    for (const Point2& point : points) chart.Dot(point, is_own ? 4 : 2.5, colour);
    chart.Polyline({{kLeft + kPlotWidth + 14, legend - 4}, {kLeft + kPlotWidth + 34, legend - 4}}, colour,
                   is_own ? 3 : 1.5);
    chart.Text({kLeft + kPlotWidth + 40, legend}, LabelOf(subject));
    legend += 20;
  }
  return chart.Close();
}

}  // namespace runnel::bench
