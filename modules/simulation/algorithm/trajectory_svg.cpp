#include "modules/simulation/algorithm/trajectory_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "modules/simulation/algorithm/internal/svg_writer.h"
#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/world_geometry.h"

namespace runnel {

namespace {

using internal::Decimal;

constexpr double kMargin = 28.0;  // pixels, like everything here that is not said to be m
constexpr double kHeader = 74.0;
constexpr double kFooter = 50.0;
constexpr double kPlotWidth = 904.0;
constexpr double kGreatestPlotHeight = 760.0;
constexpr double kAirAroundTheWorld = 0.7;  // m
constexpr double kArrowEvery = 1.6;         // m

constexpr std::string_view kFloor = "#f6f7f9";
constexpr std::string_view kObstacle = "#cdd4de";
constexpr std::string_view kObstacleEdge = "#8d99aa";
constexpr std::string_view kInk = "#1f2733";
constexpr std::string_view kFaintInk = "#667182";
constexpr std::string_view kHit = "#c9302c";
constexpr std::string_view kLeave = "#6b3fa0";
constexpr std::string_view kStart = "#1f2733";
constexpr std::string_view kGoal = "#128a4f";

struct ModeLook {
  PathMode mode;
  std::string_view colour;
  std::string_view label;
};
constexpr std::array<ModeLook, 3> kModes = {
    {{PathMode::kDrivingToGoal, "#2468d6", "driving to the goal"},
     {PathMode::kFollowingWall, "#e07b1a", "following a wall"},
     {PathMode::kGoingToLeavePoint, "#139c8f", "going to the leave point"}}};

std::string_view ColourOf(PathMode mode) {
  const auto look = std::ranges::find(kModes, mode, &ModeLook::mode);
  return look == kModes.end() ? kInk : look->colour;
}

std::string_view ColourOf(VerdictTone tone) {
  switch (tone) {
    case VerdictTone::kGood:
      return "#128a4f";
    case VerdictTone::kNeutral:
      return "#b06a00";
    case VerdictTone::kBad:
      return "#c9302c";
  }
  return kInk;
}

bool IsFinite(Point2 point) { return std::isfinite(point.x) && std::isfinite(point.y); }

/// Attributes from names and values in turn.
std::string Style(std::initializer_list<std::string_view> names_and_values) {
  std::string style;
  for (auto at = names_and_values.begin(); at != names_and_values.end(); at += 2) {
    if (!style.empty()) style += ' ';
    style += std::string(at[0]) + "=\"" + std::string(at[1]) + "\"";
  }
  return style;
}

struct Extent {
  Point2 low = {0.0, 0.0};
  Point2 high = {0.0, 0.0};

  void Include(Point2 point, double reach = 0.0) {
    if (!IsFinite(point)) return;
    low = {std::min(low.x, point.x - reach), std::min(low.y, point.y - reach)};
    high = {std::max(high.x, point.x + reach), std::max(high.y, point.y + reach)};
  }
};

Extent ExtentOf(const World& world, const Trajectory& trajectory) {
  Extent extent{Position(world.start), Position(world.start)};
  extent.Include(world.goal);
  const Outline outline = OutlineOf(world);
  for (const Outline::Flat& flat : outline.flats) extent.Include(flat.ground.from);
  for (const Outline::Round& round : outline.rounds) extent.Include(round.centre, round.radius);
  for (const PathSample& sample : trajectory.path) extent.Include(sample.position);
  extent.low = extent.low - Point2{kAirAroundTheWorld, kAirAroundTheWorld};
  extent.high = extent.high + Point2{kAirAroundTheWorld, kAirAroundTheWorld};
  return extent;
}

class Drawing {
 public:
  Drawing(const World& world, const Trajectory& trajectory)
      : world_(world), trajectory_(trajectory), extent_(ExtentOf(world, trajectory)) {
    const Point2 size = extent_.high - extent_.low;
    scale_ = std::min(kPlotWidth / size.x, kGreatestPlotHeight / size.y);
    plot_height_ = scale_ * size.y;
    while (std::max(size.x, size.y) / grid_ > 60.0) grid_ *= 10.0;
    const double spare = kPlotWidth / scale_ - size.x;  // m; tall worlds stand in the middle
    extent_.low.x -= spare / 2;
    extent_.high.x += spare / 2;
  }

  std::string Draw() {
    svg_.Open(kPlotWidth + 2 * kMargin, kHeader + plot_height_ + kFooter);
    svg_.Rectangle({0, 0}, kPlotWidth + 2 * kMargin, kHeader + plot_height_ + kFooter,
                   Style({"fill", "#ffffff"}));
    DrawCaption();
    DrawFloor();
    DrawObstacles();
    DrawFrame();
    DrawStraightLine();
    DrawPath();
    DrawRobot();
    DrawMarks();
    DrawLegend();
    DrawScaleBar();
    return svg_.Close();
  }

 private:
  Point2 Pixel(Point2 place) const {
    return {kMargin + scale_ * (place.x - extent_.low.x),
            kHeader + scale_ * (extent_.high.y - place.y)};
  }

  std::vector<Point2> Pixels(const std::vector<Point2>& places) const {
    std::vector<Point2> pixels;
    for (const Point2 place : places) pixels.push_back(Pixel(place));
    return pixels;
  }

  void DrawCaption() {
    svg_.Text({kMargin, 34}, world_.name,
              Style({"class", "name", "font-size", "22", "font-weight", "bold", "fill", kInk}));
    double x = kMargin;
    if (!trajectory_.verdict.empty()) {
      const std::string_view colour = ColourOf(trajectory_.tone);
      svg_.Circle({x + 5, 54}, 5, Style({"fill", colour}));
      svg_.Text(
          {x + 17, 59}, trajectory_.verdict,
          Style({"class", "verdict", "font-size", "15", "font-weight", "bold", "fill", colour}));
    }
    svg_.Text(
        {kMargin + kPlotWidth, 59}, Figures(),
        Style({"class", "figures", "font-size", "15", "fill", kFaintInk, "text-anchor", "end"}));
  }

  std::string Figures() const {
    const double direct = Distance(Position(world_.start), world_.goal);
    return "path " + Decimal(LengthOf(trajectory_.path)) + " m   ·   straight line " +
           Decimal(direct) + " m   ·   time " + Decimal(trajectory_.duration, 1) + " s";
  }

  void DrawFloor() {
    svg_.Rectangle({kMargin, kHeader}, kPlotWidth, plot_height_,
                   Style({"class", "floor", "fill", kFloor}));
    svg_.OpenGroup(Style({"class", "grid", "stroke", "#e3e7ec", "stroke-width", "1"}));
    for (double x = grid_ * std::ceil(extent_.low.x / grid_); x <= extent_.high.x; x += grid_) {
      svg_.Line(Pixel({x, extent_.low.y}), Pixel({x, extent_.high.y}), "");
    }
    for (double y = grid_ * std::ceil(extent_.low.y / grid_); y <= extent_.high.y; y += grid_) {
      svg_.Line(Pixel({extent_.low.x, y}), Pixel({extent_.high.x, y}), "");
    }
    svg_.CloseGroup();
  }

  /// Edges of all first, then all that is solid, so that obstacles that overlap become one.
  void DrawObstacles() {
    svg_.OpenGroup(Style({"class", "obstacle-edges", "fill", "none", "stroke", kObstacleEdge,
                          "stroke-linejoin", "round", "stroke-linecap", "round"}));
    DrawObstacleShapes(kObstacleEdge, 2.4);
    svg_.CloseGroup();
    svg_.OpenGroup(Style({"class", "obstacles", "fill", kObstacle, "stroke-linejoin", "round",
                          "stroke-linecap", "round"}));
    DrawObstacleShapes(kObstacle, 0.0);
    svg_.CloseGroup();
  }

  void DrawObstacleShapes(std::string_view wall_colour, double edge) {
    const std::string style = Style({"stroke-width", Decimal(edge)});
    if (world_.bounds) {
      const auto [low, high] = extent_;
      svg_.Rings({Pixels({low, {high.x, low.y}, high, {low.x, high.y}}), Pixels(*world_.bounds)},
                 style + " " + Style({"class", "bounds"}));
    }
    for (const PolygonObstacle& polygon : world_.polygons) {
      std::vector<std::vector<Point2>> rings = {Pixels(polygon.outline)};
      for (const Ring& hole : polygon.holes) rings.push_back(Pixels(hole));
      svg_.Rings(rings, style + " " + Style({"class", "polygon"}));
    }
    for (const BoxObstacle& box : world_.boxes) {
      svg_.Rings({Pixels(CornersOf(box))}, style + " " + Style({"class", "box"}));
    }
    for (const CylinderObstacle& cylinder : world_.cylinders) {
      svg_.Circle(Pixel(cylinder.centre), scale_ * cylinder.radius,
                  style + " " + Style({"class", "cylinder"}));
    }
    for (const WallObstacle& wall : world_.walls) {
      svg_.Polyline(Pixels(wall.points),
                    Style({"class", "wall", "fill", "none", "stroke", wall_colour, "stroke-width",
                           Decimal(scale_ * wall.thickness + edge)}));
    }
  }

  void DrawFrame() {
    svg_.Rectangle({kMargin, kHeader}, kPlotWidth, plot_height_,
                   Style({"fill", "none", "stroke", "#c3cad4", "stroke-width", "1"}));
  }

  void DrawStraightLine() {
    svg_.Line(Pixel(Position(world_.start)), Pixel(world_.goal),
              Style({"class", "straight-line", "stroke", "#9aa5b4", "stroke-width", "1.2",
                     "stroke-dasharray", "5 5"}));
  }

  /// Samples closer than a pixel's fraction say nothing and make a big file.
  std::vector<PathSample> ThinnedPath() const {
    std::vector<PathSample> thinned;
    for (const PathSample& sample : trajectory_.path) {
      if (!IsFinite(sample.position)) continue;
      const bool far = thinned.empty() || thinned.back().mode != sample.mode ||
                       scale_ * Distance(thinned.back().position, sample.position) > 0.7;
      if (far) thinned.push_back(sample);
    }
    return thinned;
  }

  void DrawPath() {
    const std::vector<PathSample> path = ThinnedPath();
    DrawPathLines(path, true);
    DrawPathLines(path, false);
    DrawArrows(path);
  }

  /// A light casing below the coloured lines keeps crossings legible.
  void DrawPathLines(const std::vector<PathSample>& path, bool is_casing) {
    svg_.OpenGroup(
        Style({"class", is_casing ? "casing" : "path", "fill", "none", "stroke-linejoin", "round",
               "stroke-linecap", "round", "stroke-width", is_casing ? "6" : "3"}));
    std::size_t first = 0;
    for (std::size_t i = 1; i <= path.size(); ++i) {
      if (i < path.size() && path[i].mode == path[first].mode) continue;
      std::vector<Point2> line;
      for (std::size_t p = first; p < std::min(i + 1, path.size()); ++p) {
        line.push_back(Pixel(path[p].position));
      }
      svg_.Polyline(line, Style({"stroke", is_casing ? "#ffffff" : ColourOf(path[first].mode)}));
      first = i;
    }
    svg_.CloseGroup();
  }

  void DrawArrows(const std::vector<PathSample>& path) {
    const double every = kArrowEvery * grid_;
    double to_next = every / 2;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Point2 step = path[i].position - path[i - 1].position;
      const double length = Norm(step);
      for (; to_next < length; to_next += every) {
        DrawArrow(path[i - 1].position + (to_next / length) * step, Direction(step),
                  ColourOf(path[i - 1].mode));
      }
      to_next -= length;
    }
  }

  void DrawArrow(Point2 place, double direction, std::string_view colour) {
    const Pose2 pose = {place.x, place.y, direction};
    const double size = 6.5 / scale_;
    svg_.Rings({Pixels({ToWorld(pose, {size, 0}), ToWorld(pose, {-size, 0.8 * size}),
                        ToWorld(pose, {-0.5 * size, 0}), ToWorld(pose, {-size, -0.8 * size})})},
               Style({"class", "arrow", "fill", colour, "stroke", "#ffffff", "stroke-width", "1"}));
  }

  void DrawRobot() {
    if (!trajectory_.end || !IsFinite(Position(*trajectory_.end))) return;
    const Pose2& end = *trajectory_.end;
    const double radius = trajectory_.robot_radius;
    svg_.Circle(Pixel(Position(end)), scale_ * radius,
                Style({"class", "robot", "fill", "#ffffff", "fill-opacity", "0.85", "stroke", kInk,
                       "stroke-width", "2"}));
    svg_.Line(Pixel(Position(end)), Pixel(ToWorld(end, {radius, 0})),
              Style({"class", "robot-heading", "stroke", kInk, "stroke-width", "2"}));
  }

  void DrawMarks() {
    const Point2 start = Pixel(Position(world_.start));
    svg_.Circle(
        start, 6,
        Style({"class", "start", "fill", kStart, "stroke", "#ffffff", "stroke-width", "2"}));
    DrawLabel(start + Point2{-10, -11}, "start", kStart);
    DrawGoal(Pixel(world_.goal));
    for (std::size_t i = 0; i < trajectory_.hits.size(); ++i) {
      DrawHit(Pixel(trajectory_.hits[i]), "H" + std::to_string(i + 1));
    }
    for (std::size_t i = 0; i < trajectory_.leaves.size(); ++i) {
      DrawLeave(Pixel(trajectory_.leaves[i]), "L" + std::to_string(i + 1));
    }
  }

  /// A flag, so that it stays visible where the robot stands on the goal.
  void DrawGoal(Point2 foot) {
    const Point2 top = foot + Point2{0, -26};
    svg_.Line(foot, top, Style({"stroke", "#ffffff", "stroke-width", "5"}));
    svg_.Rings({{top, top + Point2{17, 6}, top + Point2{0, 12}}},
               Style({"class", "goal", "fill", kGoal, "stroke", "#ffffff", "stroke-width", "1"}));
    svg_.Line(foot, top,
              Style({"stroke", kGoal, "stroke-width", "2.2", "stroke-linecap", "round"}));
    svg_.Circle(foot, 3.2, Style({"fill", kGoal, "stroke", "#ffffff", "stroke-width", "1"}));
    DrawLabel(top + Point2{-6, -7}, "goal", kGoal);
  }

  void DrawHit(Point2 place, std::string_view label) {
    if (!IsFinite(place)) return;
    svg_.Circle(place, 5,
                Style({"class", "hit", "fill", kHit, "stroke", "#ffffff", "stroke-width", "1.5"}));
    if (!label.empty()) DrawLabel(place + Point2{8, 16}, label, kHit);
  }

  void DrawLeave(Point2 place, std::string_view label) {
    if (!IsFinite(place)) return;
    svg_.Rings(
        {{place + Point2{0, -6}, place + Point2{6, 0}, place + Point2{0, 6},
          place + Point2{-6, 0}}},
        Style({"class", "leave", "fill", kLeave, "stroke", "#ffffff", "stroke-width", "1.5"}));
    if (!label.empty()) DrawLabel(place + Point2{8, -8}, label, kLeave);
  }

  /// With a light rim, because labels stand on lines.
  void DrawLabel(Point2 place, std::string_view text, std::string_view colour) {
    constexpr std::string_view kFont = "font-size=\"13\" font-weight=\"bold\" ";
    svg_.Text(
        place, text,
        std::string(kFont) + Style({"fill", "#ffffff", "stroke", "#ffffff", "stroke-width", "3.5",
                                    "stroke-linejoin", "round", "aria-hidden", "true"}));
    svg_.Text(place, text, std::string(kFont) + Style({"class", "label", "fill", colour}));
  }

  bool IsUsed(PathMode mode) const {
    return std::ranges::find(trajectory_.path, mode, &PathSample::mode) != trajectory_.path.end();
  }

  void DrawLegend() {
    const double y = kHeader + plot_height_ + 28;
    double x = kMargin;
    for (const ModeLook& look : kModes) {
      if (!IsUsed(look.mode)) continue;
      svg_.Line({x, y - 4}, {x + 24, y - 4},
                Style({"stroke", look.colour, "stroke-width", "3", "stroke-linecap", "round"}));
      x = DrawLegendText({x + 32, y}, look.label);
    }
    if (!trajectory_.hits.empty()) {
      DrawHit({x + 6, y - 4}, "");
      x = DrawLegendText({x + 18, y}, "hit point");
    }
    if (!trajectory_.leaves.empty()) {
      DrawLeave({x + 6, y - 4}, "");
      DrawLegendText({x + 18, y}, "leave point");
    }
  }

  /// Where the next entry begins.
  double DrawLegendText(Point2 place, std::string_view text) {
    svg_.Text(place, text, Style({"class", "legend", "font-size", "13", "fill", kFaintInk}));
    return place.x + 6.6 * static_cast<double>(text.size()) + 22;
  }

  void DrawScaleBar() {
    const double y = kHeader + plot_height_ + 24, right = kMargin + kPlotWidth;
    const double left = right - scale_ * grid_;
    const std::string style = Style({"stroke", kFaintInk, "stroke-width", "1.5"});
    svg_.Line({left, y}, {right, y}, style);
    svg_.Line({left, y - 4}, {left, y + 4}, style);
    svg_.Line({right, y - 4}, {right, y + 4}, style);
    svg_.Text(
        {left - 8, y + 4}, Decimal(grid_, 0) + " m",
        Style({"class", "scale", "font-size", "13", "fill", kFaintInk, "text-anchor", "end"}));
  }

  const World& world_;
  const Trajectory& trajectory_;
  Extent extent_;
  double scale_ = 1.0;  // pixels per m
  double plot_height_ = 0.0;
  double grid_ = 1.0;  // m from line to line
  internal::SvgWriter svg_;
};

}  // namespace

double LengthOf(const std::vector<PathSample>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = Distance(path[i - 1].position, path[i].position);
    if (std::isfinite(step)) length += step;
  }
  return length;
}

std::string TrajectorySvg(const World& world, const Trajectory& trajectory) {
  return Drawing(world, trajectory).Draw();
}

}  // namespace runnel
