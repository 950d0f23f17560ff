#include "modules/simulation/world_file/world_file.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/xml/xml_document.h"
#include "core/xml/xml_reading.h"
#include "core/xml/xml_writing.h"
#include "modules/simulation/algorithm/world_checks.h"

namespace runnel {

namespace {

using Names = std::vector<std::string>;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Which part of the world it is, as a WorldFault has it.
using PartKey = std::tuple<WorldPart, std::size_t, std::size_t>;

class WorldReader {
 public:
  explicit WorldReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  std::optional<World> Read(XmlElement root) {
    if (root.name() != "world") {
      Report(root, "a world file begins with <world>, not <" + root.name() + ">");
      return std::nullopt;
    }
    const std::size_t errors_before = diagnostics_.errors().size();
    Check(root, {"name"}, {"start", "goal", "polygon", "box", "cylinder", "wall", "bounds"});
    if (const std::string* name = ReadText(root, "name", diagnostics_)) world_.name = *name;
    for (const XmlElement child : root.children()) ReadPart(child);
    if (!Has(WorldPart::kStart)) Report(root, "the world has no <start>", "add <start x=\"…\" y=\"…\"/>");
    if (!Has(WorldPart::kGoal)) Report(root, "the world has no <goal>", "add <goal x=\"…\" y=\"…\"/>");
    ReportFaults();
    if (diagnostics_.errors().size() != errors_before) return std::nullopt;
    return std::move(world_);
  }

 private:
  void Report(XmlElement element, std::string message, std::string hint = {}) {
    diagnostics_.Add({.message = std::move(message), .position = element.position(), .hint = std::move(hint)});
  }

  void ReadPart(XmlElement element) {
    const std::string& name = element.name();
    if (name == "start") ReadStart(element);
    if (name == "goal") ReadGoal(element);
    if (name == "polygon") ReadPolygon(element);
    if (name == "box") ReadBox(element);
    if (name == "cylinder") ReadCylinder(element);
    if (name == "wall") ReadWall(element);
    if (name == "bounds") ReadBounds(element);
  }

  void Check(XmlElement element, const Names& attributes, const Names& children = {}) {
    CheckAttributes(element, attributes, diagnostics_);
    CheckChildren(element, children, diagnostics_);
  }

  /// The element's place becomes known; another one of a kind of which there is one is an error.
  void TakeOnly(XmlElement element, WorldPart part) {
    const auto [place, is_first] = places_.try_emplace({part, 0, 0}, element);
    if (is_first) return;
    Report(element, "the world has a second <" + element.name() + ">",
           "the first is in line " + std::to_string(place->second.position().line));
  }
  bool Has(WorldPart part) const { return places_.contains({part, 0, 0}); }

  /// Without a number the element is told of already, and its geometry means nothing.
  double Number(XmlElement element, const char* attribute) {
    const std::optional<double> number = ReadNumber(element, attribute, diagnostics_);
    if (!number) incomplete_.push_back(element);
    return number.value_or(kNoNumber);
  }

  Point2 ReadPlace(XmlElement element) {
    const double x = Number(element, "x");
    return {x, Number(element, "y")};
  }

  double ReadHeight(XmlElement element) {
    return ReadNumberOr(element, "height", kDefaultObstacleHeight, diagnostics_);
  }

  Pose2 ReadPose(XmlElement element) {
    const Point2 place = ReadPlace(element);
    return {place.x, place.y, ReadNumberOr(element, "heading", 0.0, diagnostics_)};
  }

  std::vector<Point2> ReadPoints(XmlElement element) {
    std::vector<Point2> points;
    for (const XmlElement child : element.children()) {
      if (child.name() != "point") continue;
      Check(child, {"x", "y"});
      points.push_back(ReadPlace(child));
    }
    return points;
  }

  void ReadStart(XmlElement element) {
    TakeOnly(element, WorldPart::kStart);
    Check(element, {"x", "y", "heading"});
    world_.start = ReadPose(element);
  }

  void ReadGoal(XmlElement element) {
    TakeOnly(element, WorldPart::kGoal);
    Check(element, {"x", "y"});
    world_.goal = ReadPlace(element);
  }

  void ReadPolygon(XmlElement element) {
    Check(element, {"height"}, {"point", "hole"});
    PolygonObstacle polygon{.outline = ReadPoints(element), .height = ReadHeight(element)};
    const std::size_t index = world_.polygons.size();
    for (const XmlElement child : element.children()) {
      if (child.name() != "hole") continue;
      Check(child, {}, {"point"});
      places_.emplace(PartKey{WorldPart::kHole, index, polygon.holes.size()}, child);
      polygon.holes.push_back(ReadPoints(child));
    }
    places_.emplace(PartKey{WorldPart::kPolygon, index, 0}, element);
    world_.polygons.push_back(std::move(polygon));
  }

  void ReadBox(XmlElement element) {
    Check(element, {"x", "y", "heading", "length", "width", "height"});
    const Pose2 pose = ReadPose(element);
    const double length = Number(element, "length");
    const double width = Number(element, "width");
    places_.emplace(PartKey{WorldPart::kBox, world_.boxes.size(), 0}, element);
    world_.boxes.push_back({pose, length, width, ReadHeight(element)});
  }

  void ReadCylinder(XmlElement element) {
    Check(element, {"x", "y", "radius", "height"});
    const Point2 centre = ReadPlace(element);
    const double radius = Number(element, "radius");
    places_.emplace(PartKey{WorldPart::kCylinder, world_.cylinders.size(), 0}, element);
    world_.cylinders.push_back({centre, radius, ReadHeight(element)});
  }

  void ReadWall(XmlElement element) {
    Check(element, {"thickness", "height"}, {"point"});
    const double thickness = Number(element, "thickness");
    places_.emplace(PartKey{WorldPart::kWall, world_.walls.size(), 0}, element);
    world_.walls.push_back({ReadPoints(element), thickness, ReadHeight(element)});
  }

  void ReadBounds(XmlElement element) {
    TakeOnly(element, WorldPart::kBounds);
    Check(element, {}, {"point"});
    world_.bounds = ReadPoints(element);
  }

  bool IsComplete(XmlElement element) const {
    return std::ranges::none_of(incomplete_, [element](XmlElement inner) {
      for (std::optional<XmlElement> at = inner; at; at = at->parent()) {
        if (*at == element) return true;
      }
      return false;
    });
  }

  void ReportFaults() {
    if (!Has(WorldPart::kStart)) world_.start = {kNoNumber, kNoNumber, 0.0};
    for (WorldFault& fault : FaultsOf(world_)) {
      // Their numbers are finite or told of already.
      if (fault.part == WorldPart::kStart || fault.part == WorldPart::kGoal) continue;
      const XmlElement place = places_.at({fault.part, fault.index, fault.hole});
      if (IsComplete(place)) Report(place, std::move(fault.message));
    }
  }

  Diagnostics& diagnostics_;
  World world_;
  std::vector<XmlElement> incomplete_;
  std::map<PartKey, XmlElement> places_;
};

std::optional<World> ReadDocument(const Result<XmlDocument>& document, Diagnostics& diagnostics) {
  if (document) return WorldReader(diagnostics).Read(document->root());
  diagnostics.Add(document.error());
  return std::nullopt;
}

}  // namespace

std::optional<World> ReadWorldFile(const std::filesystem::path& path, Diagnostics& diagnostics) {
  return ReadDocument(XmlDocument::Load(path), diagnostics);
}

std::optional<World> ReadWorld(std::string_view text, std::string file_name, Diagnostics& diagnostics) {
  return ReadDocument(XmlDocument::Parse(text, std::move(file_name)), diagnostics);
}

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
