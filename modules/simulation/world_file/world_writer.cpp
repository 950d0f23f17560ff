#include <charconv>
#include <string_view>

#include "core/xml/xml_writing.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel {

namespace {

std::string Attribute(std::string_view name, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return " " + std::string(name) + "=\"" + std::string(digits, end) + "\"";
}

std::string AttributeUnless(double usual, std::string_view name, double value) {
  return value == usual ? "" : Attribute(name, value);
}

std::string Place(Point2 point) { return Attribute("x", point.x) + Attribute("y", point.y); }

std::string Place(const Pose2& pose) { return Place(Position(pose)) + AttributeUnless(0.0, "heading", pose.heading); }

std::string Height(double height) { return AttributeUnless(kDefaultObstacleHeight, "height", height); }

std::string Points(const std::vector<Point2>& points, const std::string& indent) {
  std::string text;
  for (const Point2 point : points) text += indent + "<point" + Place(point) + "/>\n";
  return text;
}

std::string Write(const PolygonObstacle& polygon) {
  std::string text = "  <polygon" + Height(polygon.height) + ">\n" + Points(polygon.outline, "    ");
  for (const Ring& hole : polygon.holes) {
    text += "    <hole>\n" + Points(hole, "      ") + "    </hole>\n";
  }
  return text + "  </polygon>\n";
}

std::string Write(const BoxObstacle& box) {
  return "  <box" + Place(box.pose) + Attribute("length", box.length) + Attribute("width", box.width) +
         Height(box.height) + "/>\n";
}

std::string Write(const CylinderObstacle& cylinder) {
  return "  <cylinder" + Place(cylinder.centre) + Attribute("radius", cylinder.radius) + Height(cylinder.height) +
         "/>\n";
}

std::string Write(const WallObstacle& wall) {
  return "  <wall" + Attribute("thickness", wall.thickness) + Height(wall.height) + ">\n" +
         Points(wall.points, "    ") + "  </wall>\n";
}

template <typename Obstacle>
std::string WriteAll(const std::vector<Obstacle>& obstacles) {
  std::string text;
  for (const Obstacle& obstacle : obstacles) text += Write(obstacle);
  return text;
}

}  // namespace

std::string WriteWorld(const World& world) {
  std::string text = "<world name=\"" + EscapedAttribute(world.name) + "\">\n";
  text += "  <start" + Place(world.start) + "/>\n  <goal" + Place(world.goal) + "/>\n";
  text += WriteAll(world.polygons) + WriteAll(world.boxes);
  text += WriteAll(world.cylinders) + WriteAll(world.walls);
  if (world.bounds) text += "  <bounds>\n" + Points(*world.bounds, "    ") + "  </bounds>\n";
  return text + "</world>\n";
}

}  // namespace runnel
