#include "apps/arena/html_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/arena/table.h"
#include "core/base/characters.h"
#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel::arena {

namespace {

constexpr double kAir = 0.6;  // m, round all that is shown

// The y axis is turned over here rather than by a transform, so that a page can be read.
std::string Pair(Point2 point) { return Fixed(point.x, 2) + "," + Fixed(-point.y, 2); }

std::string Points(const std::vector<Point2>& points) {
  std::string text;
  for (const Point2 point : points) text += (text.empty() ? "" : " ") + Pair(point);
  return text;
}

std::string Attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + Fixed(value, 3) + "\"";
}

std::string CircleAt(Point2 centre, double radius, const char* look) {
  return std::string("<circle class=\"") + look + "\"" + Attribute("cx", centre.x) +
         Attribute("cy", -centre.y) + Attribute("r", radius) + "/>";
}

std::string Polyline(const std::vector<Point2>& points, const char* look) {
  return std::string("<polyline class=\"") + look + "\" points=\"" + Points(points) + "\"/>";
}

std::string Rings(const std::vector<Ring>& rings) {
  std::string text = "<path class=\"solid\" d=\"";
  for (const Ring& ring : rings) text += "M" + Points(ring) + "z";
  return text + "\"/>";
}

std::string ObstaclesOf(const World& world, const Extent& view) {
  std::string text;
  if (world.bounds) {
    text += Rings({{view.low, {view.high.x, view.low.y}, view.high, {view.low.x, view.high.y}},
                   *world.bounds});
  }
  for (const PolygonObstacle& polygon : world.polygons) {
    std::vector<Ring> rings{polygon.outline};
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
    text += Rings(rings);
  }
  for (const BoxObstacle& box : world.boxes) text += Rings({CornersOf(box)});
  for (const CylinderObstacle& cylinder : world.cylinders) {
    text += CircleAt(cylinder.centre, cylinder.radius, "solid");
  }
  for (const WallObstacle& wall : world.walls) {
    text += "<polyline class=\"wall\"" + Attribute("stroke-width", wall.thickness) + " points=\"" +
            Points(wall.points) + "\"/>";
  }
  return text;
}

std::string ViewBoxText(const Extent& view) {
  const Point2 size = view.high - view.low;
  return "viewBox=\"" + Fixed(view.low.x, 2) + " " + Fixed(-view.high.y, 2) + " " +
         Fixed(size.x, 2) + " " + Fixed(size.y, 2) + "\"";
}

constexpr std::array<const char*, 3> kLooks{"goal-bound", "following", "returning"};

std::string PathOf(const std::vector<PathSample>& path) {
  std::string text;
  for (std::size_t first = 0; first < path.size();) {
    std::size_t end = first;
    std::vector<Point2> line;
    while (end < path.size() && path[end].mode == path[first].mode) {
      line.push_back(path[end++].position);
    }
    if (end < path.size()) line.push_back(path[end].position);
    text += Polyline(line, kLooks[static_cast<std::size_t>(path[first].mode)]);
    first = end;
  }
  return text;
}

}  // namespace

Extent ViewOf(const Course& course) {
  const Extent extent = ExtentOf(course.world);
  return {extent.low - Point2{kAir, kAir}, extent.high + Point2{kAir, kAir}};
}

std::string WorldSymbol(const std::string& id, const Course& course, const Extent& view) {
  std::string text = "<symbol id=\"" + id + "\" " + ViewBoxText(view) + ">";
  text += ObstaclesOf(course.world, view);
  if (course.shortest) text += Polyline(course.shortest->points, "shortest");
  const double mark = 0.012 * Norm(view.high - view.low);
  text += CircleAt(Position(course.world.start), mark, "start");
  text += CircleAt(course.world.goal, mark, "goal");
  return text + "</symbol>\n";
}

std::string RunDrawing(const std::string& world_id, const RunRecord& record, const Extent& view) {
  const double mark = 0.009 * Norm(view.high - view.low);
  const Point2 size = view.high - view.low;
  std::string text = "<svg role=\"img\" aria-label=\"" + EscapedMarkup(TextOf(record.key)) + "\" " +
                     ViewBoxText(view) + "><use href=\"#" + world_id + "\"" +
                     Attribute("x", view.low.x) + Attribute("y", -view.high.y) +
                     Attribute("width", size.x) + Attribute("height", size.y) + "/>";
  text += PathOf(record.result.path);
  for (const Point2 hit : record.result.hits) text += CircleAt(hit, mark, "hit");
  for (const Point2 leave : record.result.leaves) text += CircleAt(leave, mark, "leave");
  return text + "</svg>";
}

}  // namespace runnel::arena
