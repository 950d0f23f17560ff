#include "modules/simulation/algorithm/trajectory_svg.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "modules/simulation/algorithm/internal/drawing.h"

namespace runnel {

namespace {

using internal::kFaintInk;
using internal::kFooter;
using internal::kHeader;
using internal::kInk;
using internal::kMargin;
using internal::kPlotWidth;
using internal::Style;

constexpr std::string_view kHit = "#c9302c";
constexpr std::string_view kLeave = "#6b3fa0";
constexpr std::string_view kStart = "#1f2733";
constexpr std::string_view kGoal = "#128a4f";

// By VerdictTone.
constexpr std::array<std::string_view, 3> kTones{"#128a4f", "#b06a00", "#c9302c"};

Extent ExtentOf(const World& world, const Trajectory& trajectory) {
  Extent extent = ExtentOf(world);
  for (const PathSample& sample : trajectory.path) extent.Include(sample.position);
  return extent;
}

class Drawing {
 public:
  Drawing(const World& world, const Trajectory& trajectory)
      : world_(world), trajectory_(trajectory), canvas_(ExtentOf(world, trajectory)) {}

  std::string Draw() {
    svg_.Open(kPlotWidth + 2 * kMargin, kHeader + canvas_.plot_height() + kFooter);
    svg_.Rectangle({0, 0}, kPlotWidth + 2 * kMargin, kHeader + canvas_.plot_height() + kFooter,
                   Style({"fill", "#ffffff"}));
    DrawCaption();
    internal::DrawFloor(canvas_);
    internal::DrawObstacles(world_, canvas_);
    DrawStraightLine();
    internal::DrawPath(trajectory_.path, canvas_);
    DrawRobot();
    DrawMarks();
    DrawLegend();
    internal::DrawScaleBar(canvas_);
    return svg_.Close();
  }

 private:
  void DrawCaption() {
    svg_.Text({kMargin, 34}, world_.name,
              Style({"class", "name", "font-size", "22", "font-weight", "bold", "fill", kInk}));
    double x = kMargin;
    if (!trajectory_.verdict.empty()) {
      const std::string_view colour = kTones[static_cast<std::size_t>(trajectory_.tone)];
      svg_.Circle({x + 5, 54}, 5, Style({"fill", colour}));
      svg_.Text({x + 17, 59}, trajectory_.verdict,
                Style({"class", "verdict", "font-size", "15", "font-weight", "bold", "fill", colour}));
    }
    svg_.Text({kMargin + kPlotWidth, 59}, Figures(),
              Style({"class", "figures", "font-size", "15", "fill", kFaintInk, "text-anchor", "end"}));
  }

  std::string Figures() const {
    const double direct = Distance(Position(world_.start), world_.goal);
    return "path " + Decimal(trajectory_.length) + " m   ·   straight line " + Decimal(direct) + " m   ·   time " +
           Decimal(trajectory_.duration, 1) + " s";
  }

  void DrawStraightLine() {
    svg_.Line(canvas_.Pixel(Position(world_.start)), canvas_.Pixel(world_.goal),
              Style({"class", "straight-line", "stroke", "#9aa5b4", "stroke-width", "1.2", "stroke-dasharray", "5 5"}));
    if (!trajectory_.shortest.empty()) DrawShortest(canvas_.Pixels(trajectory_.shortest));
  }

  void DrawShortest(const std::vector<Point2>& pixels) {
    svg_.Polyline(pixels, Style({"class", "shortest", "fill", "none", "stroke", "#667182", "stroke-width", "1.6",
                                 "stroke-dasharray", "2 4"}));
  }

  void DrawRobot() {
    if (!trajectory_.end || !IsFinite(Position(*trajectory_.end))) return;
    const Pose2& end = *trajectory_.end;
    const double radius = trajectory_.robot_radius;
    svg_.Circle(
        canvas_.Pixel(Position(end)), canvas_.scale() * radius,
        Style({"class", "robot", "fill", "#ffffff", "fill-opacity", "0.85", "stroke", kInk, "stroke-width", "2"}));
    svg_.Line(canvas_.Pixel(Position(end)), canvas_.Pixel(ToWorld(end, {radius, 0})),
              Style({"class", "robot-heading", "stroke", kInk, "stroke-width", "2"}));
  }

  void DrawMarks() {
    const Point2 start = canvas_.Pixel(Position(world_.start));
    svg_.Circle(start, 6, Style({"class", "start", "fill", kStart, "stroke", "#ffffff", "stroke-width", "2"}));
    DrawLabel(start + Point2{-10, -11}, "start", kStart);
    DrawGoal(canvas_.Pixel(world_.goal));
    for (std::size_t i = 0; i < trajectory_.hits.size(); ++i) {
      DrawHit(canvas_.Pixel(trajectory_.hits[i]), "H" + std::to_string(i + 1));
    }
    for (std::size_t i = 0; i < trajectory_.leaves.size(); ++i) {
      DrawLeave(canvas_.Pixel(trajectory_.leaves[i]), "L" + std::to_string(i + 1));
    }
  }

  /// A flag, so that it stays visible where the robot stands on the goal.
  void DrawGoal(Point2 foot) {
    const Point2 top = foot + Point2{0, -26};
    svg_.Line(foot, top, Style({"stroke", "#ffffff", "stroke-width", "5"}));
    svg_.Rings({{top, top + Point2{17, 6}, top + Point2{0, 12}}},
               Style({"class", "goal", "fill", kGoal, "stroke", "#ffffff", "stroke-width", "1"}));
    svg_.Line(foot, top, Style({"stroke", kGoal, "stroke-width", "2.2", "stroke-linecap", "round"}));
    svg_.Circle(foot, 3.2, Style({"fill", kGoal, "stroke", "#ffffff", "stroke-width", "1"}));
    DrawLabel(top + Point2{-6, -7}, "goal", kGoal);
  }

  void DrawHit(Point2 place, std::string_view label) {
    if (!IsFinite(place)) return;
    svg_.Circle(place, 5, Style({"class", "hit", "fill", kHit, "stroke", "#ffffff", "stroke-width", "1.5"}));
    if (!label.empty()) DrawLabel(place + Point2{8, 16}, label, kHit);
  }

  void DrawLeave(Point2 place, std::string_view label) {
    if (!IsFinite(place)) return;
    svg_.Rings({{place + Point2{0, -6}, place + Point2{6, 0}, place + Point2{0, 6}, place + Point2{-6, 0}}},
               Style({"class", "leave", "fill", kLeave, "stroke", "#ffffff", "stroke-width", "1.5"}));
    if (!label.empty()) DrawLabel(place + Point2{8, -8}, label, kLeave);
  }

  /// With a light rim, because labels stand on lines.
  void DrawLabel(Point2 place, std::string_view text, std::string_view colour) {
    constexpr std::string_view kFont = "font-size=\"13\" font-weight=\"bold\" ";
    svg_.Text(place, text,
              std::string(kFont) + Style({"fill", "#ffffff", "stroke", "#ffffff", "stroke-width", "3.5",
                                          "stroke-linejoin", "round", "aria-hidden", "true"}));
    svg_.Text(place, text, std::string(kFont) + Style({"class", "label", "fill", colour}));
  }

  bool IsUsed(PathMode mode) const {
    return std::ranges::find(trajectory_.path, mode, &PathSample::mode) != trajectory_.path.end();
  }

  void DrawLegend() {
    const double y = kHeader + canvas_.plot_height() + 28;
    double x = kMargin;
    for (const internal::ModeLook& look : internal::kModes) {
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
    if (trajectory_.shortest.empty()) return;
    // In a line of its own, for want of room.
    DrawShortest({{kMargin, y + 12}, {kMargin + 24, y + 12}});
    DrawLegendText({kMargin + 32, y + 16}, "shortest path");
  }

  /// Where the next entry begins.
  double DrawLegendText(Point2 place, std::string_view text) {
    svg_.Text(place, text, Style({"class", "legend", "font-size", "13", "fill", kFaintInk}));
    return place.x + 6.6 * static_cast<double>(text.size()) + 22;
  }

  const World& world_;
  const Trajectory& trajectory_;
  internal::Canvas canvas_;
  SvgWriter& svg_ = canvas_.svg();
};

}  // namespace

std::string TrajectorySvg(const World& world, const Trajectory& trajectory) {
  return Drawing(world, trajectory).Draw();
}

}  // namespace runnel
