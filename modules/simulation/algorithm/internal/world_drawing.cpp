#include <cmath>
#include <string>

#include "modules/simulation/algorithm/internal/drawing.h"
#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel::internal {

namespace {

constexpr std::string_view kFloor = "#f6f7f9";
constexpr std::string_view kObstacle = "#cdd4de";
constexpr std::string_view kObstacleEdge = "#8d99aa";

void DrawShapes(const World& world, Canvas& canvas, std::string_view wall_colour, double edge) {
  const std::string style = Style({"stroke-width", Decimal(edge)});
  if (world.bounds) {
    const auto [low, high] = canvas.extent();
    canvas.svg().Rings({canvas.Pixels({low, {high.x, low.y}, high, {low.x, high.y}}),
                        canvas.Pixels(*world.bounds)},
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
                          Style({"class", "wall", "fill", "none", "stroke", wall_colour,
                                 "stroke-width", Decimal(canvas.scale() * wall.thickness + edge)}));
  }
}

}  // namespace

void DrawFloor(Canvas& canvas) {
  canvas.svg().Rectangle({kMargin, kHeader}, kPlotWidth, canvas.plot_height(),
                         Style({"class", "floor", "fill", kFloor}));
  canvas.svg().OpenGroup(Style({"class", "grid", "stroke", "#e3e7ec", "stroke-width", "1"}));
  for (double x = canvas.grid() * std::ceil(canvas.extent().low.x / canvas.grid());
       x <= canvas.extent().high.x; x += canvas.grid()) {
    canvas.svg().Line(canvas.Pixel({x, canvas.extent().low.y}),
                      canvas.Pixel({x, canvas.extent().high.y}), "");
  }
  for (double y = canvas.grid() * std::ceil(canvas.extent().low.y / canvas.grid());
       y <= canvas.extent().high.y; y += canvas.grid()) {
    canvas.svg().Line(canvas.Pixel({canvas.extent().low.x, y}),
                      canvas.Pixel({canvas.extent().high.x, y}), "");
  }
  canvas.svg().CloseGroup();
}

void DrawObstacles(const World& world, Canvas& canvas) {
  canvas.svg().OpenGroup(Style({"class", "obstacle-edges", "fill", "none", "stroke", kObstacleEdge,
                                "stroke-linejoin", "round", "stroke-linecap", "round"}));
  DrawShapes(world, canvas, kObstacleEdge, 2.4);
  canvas.svg().CloseGroup();
  canvas.svg().OpenGroup(Style({"class", "obstacles", "fill", kObstacle, "stroke-linejoin", "round",
                                "stroke-linecap", "round"}));
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
  canvas.svg().Text(
      {left - 8, y + 4}, Decimal(canvas.grid(), 0) + " m",
      Style({"class", "scale", "font-size", "13", "fill", kFaintInk, "text-anchor", "end"}));
}

}  // namespace runnel::internal
