#include "modules/simulation/world_file/world_reader.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/xml/xml_document.h"
#include "core/xml/xml_reading.h"
#include "modules/simulation/algorithm/world_checks.h"

namespace runnel {

namespace {

using Names = std::vector<std::string>;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Where each part of the world came from, in step with the world's own lists.
struct Places {
  std::optional<XmlElement> start, goal, bounds;
  std::vector<XmlElement> polygons, boxes, cylinders, walls;
  std::vector<std::vector<XmlElement>> holes;  // of each polygon
};

class WorldReader {
 public:
  explicit WorldReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  std::optional<World> Read(XmlElement root) {
    if (root.name() != "world") {
      Report(root, "a world file begins with <world>, not <" + root.name() + ">");
      return std::nullopt;
    }
    const std::size_t errors_before = diagnostics_.errors().size();
    CheckAttributes(root, Names{"name"}, diagnostics_);
    CheckChildren(root, Names{"start", "goal", "polygon", "box", "cylinder", "wall", "bounds"},
                  diagnostics_);
    if (const std::string* name = ReadText(root, "name", diagnostics_)) world_.name = *name;
    for (const XmlElement child : root.children()) ReadPart(child);
    if (!places_.start) Report(root, "the world has no <start>", "add <start x=\"…\" y=\"…\"/>");
    if (!places_.goal) Report(root, "the world has no <goal>", "add <goal x=\"…\" y=\"…\"/>");
    ReportFaults(root);
    if (diagnostics_.errors().size() != errors_before) return std::nullopt;
    return std::move(world_);
  }

 private:
  void Report(XmlElement element, std::string message, std::string hint = {}) {
    diagnostics_.Add(
        {.message = std::move(message), .position = element.position(), .hint = std::move(hint)});
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

  void CheckLeaf(XmlElement element, const Names& attributes) {
    CheckAttributes(element, attributes, diagnostics_);
    CheckChildren(element, {}, diagnostics_);
  }

  /// The element's place becomes known; another one of a kind of which there is one is an error.
  void TakeOnly(XmlElement element, std::optional<XmlElement>& place) {
    if (place) {
      Report(element, "the world has a second <" + element.name() + ">",
             "the first is in line " + std::to_string(place->position().line));
    } else {
      place = element;
    }
  }

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
      CheckLeaf(child, {"x", "y"});
      points.push_back(ReadPlace(child));
    }
    return points;
  }

  void ReadStart(XmlElement element) {
    TakeOnly(element, places_.start);
    CheckLeaf(element, {"x", "y", "heading"});
    world_.start = ReadPose(element);
  }

  void ReadGoal(XmlElement element) {
    TakeOnly(element, places_.goal);
    CheckLeaf(element, {"x", "y"});
    world_.goal = ReadPlace(element);
  }

  void ReadPolygon(XmlElement element) {
    CheckAttributes(element, Names{"height"}, diagnostics_);
    CheckChildren(element, Names{"point", "hole"}, diagnostics_);
    PolygonObstacle polygon{.outline = ReadPoints(element), .height = ReadHeight(element)};
    std::vector<XmlElement> holes;
    for (const XmlElement child : element.children()) {
      if (child.name() != "hole") continue;
      CheckAttributes(child, {}, diagnostics_);
      CheckChildren(child, Names{"point"}, diagnostics_);
      polygon.holes.push_back(ReadPoints(child));
      holes.push_back(child);
    }
    world_.polygons.push_back(std::move(polygon));
    places_.polygons.push_back(element);
    places_.holes.push_back(std::move(holes));
  }

  void ReadBox(XmlElement element) {
    CheckLeaf(element, {"x", "y", "heading", "length", "width", "height"});
    const Pose2 pose = ReadPose(element);
    const double length = Number(element, "length");
    const double width = Number(element, "width");
    world_.boxes.push_back({pose, length, width, ReadHeight(element)});
    places_.boxes.push_back(element);
  }

  void ReadCylinder(XmlElement element) {
    CheckLeaf(element, {"x", "y", "radius", "height"});
    const Point2 centre = ReadPlace(element);
    const double radius = Number(element, "radius");
    world_.cylinders.push_back({centre, radius, ReadHeight(element)});
    places_.cylinders.push_back(element);
  }

  void ReadWall(XmlElement element) {
    CheckAttributes(element, Names{"thickness", "height"}, diagnostics_);
    CheckChildren(element, Names{"point"}, diagnostics_);
    const double thickness = Number(element, "thickness");
    world_.walls.push_back({ReadPoints(element), thickness, ReadHeight(element)});
    places_.walls.push_back(element);
  }

  void ReadBounds(XmlElement element) {
    TakeOnly(element, places_.bounds);
    CheckAttributes(element, {}, diagnostics_);
    CheckChildren(element, Names{"point"}, diagnostics_);
    world_.bounds = ReadPoints(element);
  }

  XmlElement PlaceOf(const WorldFault& fault, XmlElement root) const {
    switch (fault.part) {
      case WorldPart::kStart:
      case WorldPart::kGoal:
        break;  // their numbers are finite or told of already
      case WorldPart::kPolygon:
        return places_.polygons[fault.index];
      case WorldPart::kHole:
        return places_.holes[fault.index][fault.hole];
      case WorldPart::kBox:
        return places_.boxes[fault.index];
      case WorldPart::kCylinder:
        return places_.cylinders[fault.index];
      case WorldPart::kWall:
        return places_.walls[fault.index];
      case WorldPart::kBounds:
        return places_.bounds.value_or(root);
    }
    return root;
  }

  bool IsComplete(XmlElement element) const {
    return std::ranges::none_of(incomplete_, [element](XmlElement inner) {
      for (std::optional<XmlElement> at = inner; at; at = at->parent()) {
        if (*at == element) return true;
      }
      return false;
    });
  }

  void ReportFaults(XmlElement root) {
    if (!places_.start) world_.start = {kNoNumber, kNoNumber, 0.0};
    for (WorldFault& fault : FaultsOf(world_)) {
      if (fault.part == WorldPart::kStart || fault.part == WorldPart::kGoal) continue;
      const XmlElement place = PlaceOf(fault, root);
      if (IsComplete(place)) Report(place, std::move(fault.message));
    }
  }

  Diagnostics& diagnostics_;
  World world_;
  std::vector<XmlElement> incomplete_;
  Places places_;
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

std::optional<World> ReadWorld(std::string_view text, std::string file_name,
                               Diagnostics& diagnostics) {
  return ReadDocument(XmlDocument::Parse(text, std::move(file_name)), diagnostics);
}

}  // namespace runnel
