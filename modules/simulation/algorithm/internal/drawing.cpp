#include "modules/simulation/algorithm/internal/drawing.h"

#include <algorithm>

#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel::internal {

namespace {

constexpr double kGreatestPlotHeight = 760.0;  // pixels
constexpr double kAir = 0.7;                   // m, round all that is shown
constexpr int kMostGridLines = 60;

constexpr std::string_view kFloor = "#f6f7f9";
constexpr std::string_view kObstacle = "#cdd4de";
constexpr std::string_view kObstacleEdge = "#8d99aa";

void DrawShapes(const World& world, Canvas& canvas, std::string_view wall_colour, double edge) {
  const std::string style = Style({"stroke-width", Decimal(edge)});
  if (world.bounds) {
    const auto [low, high] = canvas.extent();
    canvas.svg().Rings({canvas.Pixels({low, {high.x, low.y}, high, {low.x, high.y}}), canvas.Pixels(*world.bounds)},
                       style + " " + Style({"class", "bounds"}));
  }
  for (const PolygonObstacle& polygon : world.polygons) {
    std::vector<std::vector<Point2>> rings = {canvas.Pixels(polygon.outline)};
    for (const Ring& hole : polygon.holes) rings.push_back(canvas.Pixels(hole));
    canvas.svg().Rings(rings, style + " " + Style({"class", "polygon"}));
  }
  for (const BoxObstacle& box : world.boxes) {
    canvas.svg().Rings({canvas.Pixels(CornersOf(box))}, style + " " + Style({"class", "box"}));
  }
  for (const CylinderObstacle& cylinder : world.cylinders) {
    canvas.svg().Circle(canvas.Pixel(cylinder.centre), canvas.scale() * cylinder.radius,
                        style + " " + Style({"class", "cylinder"}));
  }
  for (const WallObstacle& wall : world.walls) {
    canvas.svg().Polyline(canvas.Pixels(wall.points),
                          Style({"class", "wall", "fill", "none", "stroke", wall_colour, "stroke-width",
                                 Decimal(canvas.scale() * wall.thickness + edge)}));
  }
}

constexpr double kArrowEvery = 1.6;  // m, where the grid is 1 m

std::string_view ColourOf(PathMode mode) {
  const auto look = std::ranges::find(kModes, mode, &ModeLook::mode);
  return look == kModes.end() ? kInk : look->colour;
}

/// Samples closer than a pixel's fraction say nothing and make a big file.
std::vector<PathSample> Thinned(const std::vector<PathSample>& path, double scale) {
  std::vector<PathSample> thinned;
  for (const PathSample& sample : path) {
    if (!IsFinite(sample.position)) continue;
    const bool far = thinned.empty() || thinned.back().mode != sample.mode ||
                     scale * Distance(thinned.back().position, sample.position) > 0.7;
    if (far) thinned.push_back(sample);
  }
  return thinned;
}

/// A light casing below the coloured lines keeps crossings legible.
void DrawLines(const std::vector<PathSample>& path, Canvas& canvas, bool is_casing) {
  canvas.svg().OpenGroup(Style({"class", is_casing ? "casing" : "path", "fill", "none", "stroke-linejoin", "round",
                                "stroke-linecap", "round", "stroke-width", is_casing ? "6" : "3"}));
  std::size_t first = 0;
  for (std::size_t i = 1; i <= path.size(); ++i) {
    if (i < path.size() && path[i].mode == path[first].mode) continue;
    std::vector<Point2> line;
    for (std::size_t p = first; p < std::min(i + 1, path.size()); ++p) {
      line.push_back(canvas.Pixel(path[p].position));
    }
    canvas.svg().Polyline(line, Style({"stroke", is_casing ? "#ffffff" : ColourOf(path[first].mode)}));
    first = i;
  }
  canvas.svg().CloseGroup();
}

void DrawArrow(Canvas& canvas, Point2 place, double direction, std::string_view colour) {
  const Pose2 pose = {place.x, place.y, direction};
  const double size = 6.5 / canvas.scale();
  canvas.svg().Rings({canvas.Pixels({ToWorld(pose, {size, 0}), ToWorld(pose, {-size, 0.8 * size}),
                                     ToWorld(pose, {-0.5 * size, 0}), ToWorld(pose, {-size, -0.8 * size})})},
                     Style({"class", "arrow", "fill", colour, "stroke", "#ffffff", "stroke-width", "1"}));
}

void DrawArrows(const std::vector<PathSample>& path, Canvas& canvas) {
  const double every = kArrowEvery * canvas.grid();
  double to_next = every / 2;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2 step = path[i].position - path[i - 1].position;
    const double length = Norm(step);
    for (; to_next < length; to_next += every) {
      DrawArrow(canvas, path[i - 1].position + (to_next / length) * step, Direction(step), ColourOf(path[i - 1].mode));
    }
    to_next -= length;
  }
}

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
  return {kMargin + scale_ * (place.x - extent_.low.x), kHeader + scale_ * (extent_.high.y - place.y)};
}

std::vector<Point2> Canvas::Pixels(const std::vector<Point2>& places) const {
  std::vector<Point2> pixels;
  for (const Point2 place : places) pixels.push_back(Pixel(place));
  return pixels;
}

void DrawFloor(Canvas& canvas) {
  canvas.svg().Rectangle({kMargin, kHeader}, kPlotWidth, canvas.plot_height(),
                         Style({"class", "floor", "fill", kFloor}));
  canvas.svg().OpenGroup(Style({"class", "grid", "stroke", "#e3e7ec", "stroke-width", "1"}));
  // Counted, as far from the origin the next line may be no other number.
  const auto each_line = [&](double low, double high, const auto& draw) {
    const double first = canvas.grid() * std::ceil(low / canvas.grid());
    for (int i = 0; i <= kMostGridLines && first + i * canvas.grid() <= high; ++i) draw(first + i * canvas.grid());
  };
  const auto &low = canvas.extent().low, &high = canvas.extent().high;
  each_line(low.x, high.x, [&](double x) {
    canvas.svg().Line(canvas.Pixel({x, low.y}), canvas.Pixel({x, high.y}), "");
  });
  each_line(low.y, high.y, [&](double y) {
    canvas.svg().Line(canvas.Pixel({low.x, y}), canvas.Pixel({high.x, y}), "");
  });
  canvas.svg().CloseGroup();
}

void DrawObstacles(const World& world, Canvas& canvas) {
  canvas.svg().OpenGroup(Style({"class", "obstacle-edges", "fill", "none", "stroke", kObstacleEdge, "stroke-linejoin",
                                "round", "stroke-linecap", "round"}));
  DrawShapes(world, canvas, kObstacleEdge, 2.4);
  canvas.svg().CloseGroup();
  canvas.svg().OpenGroup(
      Style({"class", "obstacles", "fill", kObstacle, "stroke-linejoin", "round", "stroke-linecap", "round"}));
  DrawShapes(world, canvas, kObstacle, 0.0);
  canvas.svg().CloseGroup();
  canvas.svg().Rectangle({kMargin, kHeader}, kPlotWidth, canvas.plot_height(),
                         Style({"fill", "none", "stroke", "#c3cad4", "stroke-width", "1"}));
}

void DrawScaleBar(Canvas& canvas) {
  const double y = kHeader + canvas.plot_height() + 24, right = kMargin + kPlotWidth;
  const double left = right - canvas.scale() * canvas.grid();
  const std::string style = Style({"stroke", kFaintInk, "stroke-width", "1.5"});
  canvas.svg().Line({left, y}, {right, y}, style);
  canvas.svg().Line({left, y - 4}, {left, y + 4}, style);
  canvas.svg().Line({right, y - 4}, {right, y + 4}, style);
  canvas.svg().Text({left - 8, y + 4}, Decimal(canvas.grid(), 0) + " m",
                    Style({"class", "scale", "font-size", "13", "fill", kFaintInk, "text-anchor", "end"}));
}

void DrawPath(const std::vector<PathSample>& path, Canvas& canvas) {
  const std::vector<PathSample> thinned = Thinned(path, canvas.scale());
  DrawLines(thinned, canvas, true);
  DrawLines(thinned, canvas, false);
  DrawArrows(thinned, canvas);
}

}  // namespace runnel::internal
