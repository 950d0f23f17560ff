#include <algorithm>

#include "bench/report/chart.h"
#include "bench/report/chart_style.h"
#include "bench/report/charts.h"
#include "bench/report/text.h"

namespace runnel::bench {

namespace {

constexpr double kWidth = 760;
constexpr double kHead = 50;
constexpr double kLine = 26;
constexpr double kLabels = 250;
constexpr double kFigures = 100;

}  // namespace

std::string BarChart(const std::vector<const Measurement*>& measurements) {
  std::vector<const Measurement*> sorted = measurements;
  const Quantity& quantity = measurements.front()->quantity;
  std::ranges::stable_sort(sorted, [&](const Measurement* one, const Measurement* other) {
    return quantity.more_is_better ? one->Typical() > other->Typical() : one->Typical() < other->Typical();
  });
  double largest = 0;
  for (const Measurement* each : sorted) largest = std::max(largest, each->Typical());

  Chart chart(kWidth, kHead + kLine * static_cast<double>(sorted.size()) + 10);
  chart.Text({12, 22}, measurements.front()->workload.name, Chart::Anchor::kStart, 16);
  chart.Text({12, 40}, TitleOf(quantity), Chart::Anchor::kStart, 12, kQuiet);
  double y = kHead;
  for (const Measurement* each : sorted) {
    const double share = largest > 0 ? each->Typical() / largest : 0;
    const double length = share * (kWidth - kLabels - kFigures);
    chart.Text({kLabels - 8, y + 16}, LabelOf(each->subject), Chart::Anchor::kEnd);
    chart.Rectangle({kLabels, y + 3}, std::max(length, 1.0), kLine - 6, BarColour(each->subject.role));
    chart.Text({kLabels + length + 6, y + 16}, WithUnit(each->Typical(), quantity.unit));
    y += kLine;
  }
  return chart.Close();
}

}  // namespace runnel::bench
