#include "bench/report/chart.h"

namespace runnel::bench {

Chart::Chart(double width, double height) {
  svg_.Open(width, height);
  Rectangle({0, 0}, width, height, "#fff");
}

void Chart::Rectangle(Point2 corner, double width, double height, const std::string& colour) {
  svg_.Rectangle(corner, width, height, "fill=\"" + colour + "\"");
}

void Chart::Polyline(const std::vector<Point2>& points, const std::string& colour, double width) {
  svg_.Polyline(points, "fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" + Decimal(width, 1) + "\"");
}

void Chart::Dot(Point2 centre, double radius, const std::string& colour) {
  svg_.Circle(centre, radius, "fill=\"" + colour + "\"");
}

void Chart::Text(Point2 at, const std::string& text, Anchor anchor, int size, const std::string& colour) {
  const char* name = anchor == Anchor::kStart ? "start" : anchor == Anchor::kMiddle ? "middle" : "end";
  svg_.Text(
      at, text,
      "text-anchor=\"" + std::string(name) + "\" font-size=\"" + std::to_string(size) + "\" fill=\"" + colour + "\"");
}

}  // namespace runnel::bench
