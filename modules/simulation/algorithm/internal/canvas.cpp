#include "modules/simulation/algorithm/internal/canvas.h"

#include <algorithm>

namespace runnel::internal {

namespace {

constexpr double kGreatestPlotHeight = 760.0;  // pixels
constexpr double kAir = 0.7;                   // m, round all that is shown
constexpr double kMostGridLines = 60.0;

}  // namespace

std::string Style(std::initializer_list<std::string_view> names_and_values) {
  std::string style;
  for (auto at = names_and_values.begin(); at != names_and_values.end(); at += 2) {
    if (!style.empty()) style += ' ';
    style += std::string(at[0]) + "=\"" + std::string(at[1]) + "\"";
  }
  return style;
}

Canvas::Canvas(const Extent& extent) : extent_(extent) {
  extent_.low = extent_.low - Point2{kAir, kAir};
  extent_.high = extent_.high + Point2{kAir, kAir};
  const Point2 size = extent_.high - extent_.low;
  scale_ = std::min(kPlotWidth / size.x, kGreatestPlotHeight / size.y);
  while (std::max(size.x, size.y) / grid_ > kMostGridLines) grid_ *= 10.0;
  const double spare = kPlotWidth / scale_ - size.x;  // tall worlds stand in the middle
  extent_.low.x -= spare / 2;
  extent_.high.x += spare / 2;
}

Point2 Canvas::Pixel(Point2 place) const {
  return {kMargin + scale_ * (place.x - extent_.low.x),
          kHeader + scale_ * (extent_.high.y - place.y)};
}

std::vector<Point2> Canvas::Pixels(const std::vector<Point2>& places) const {
  std::vector<Point2> pixels;
  for (const Point2 place : places) pixels.push_back(Pixel(place));
  return pixels;
}

}  // namespace runnel::internal
