#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/trajectory_svg.h"
#include "modules/types/algorithm/svg_writer.h"

namespace runnel::internal {

/// The layout of a picture in pixels: a caption, the plot, a legend.
inline constexpr double kMargin = 28.0;
inline constexpr double kHeader = 74.0;
inline constexpr double kFooter = 50.0;
inline constexpr double kPlotWidth = 904.0;

inline constexpr std::string_view kInk = "#1f2733";
inline constexpr std::string_view kFaintInk = "#667182";

/// Attributes from names and values in turn.
[[nodiscard]] std::string Style(std::initializer_list<std::string_view> names_and_values);

/// A part of the world (m, y up) laid out as a plot in a picture (pixels, y down).
class Canvas {
 public:
  /// Shows the extent and a little more.
  explicit Canvas(const Extent& extent);

  [[nodiscard]] SvgWriter& svg() { return svg_; }
  [[nodiscard]] const Extent& extent() const { return extent_; }  ///< m, of the plot
  [[nodiscard]] double scale() const { return scale_; }           ///< pixels per m
  [[nodiscard]] double grid() const { return grid_; }             ///< m, from line to line
  [[nodiscard]] double plot_height() const { return scale_ * (extent_.high.y - extent_.low.y); }

  [[nodiscard]] Point2 Pixel(Point2 place) const;
  [[nodiscard]] std::vector<Point2> Pixels(const std::vector<Point2>& places) const;

 private:
  Extent extent_;
  double scale_ = 1.0;
  double grid_ = 1.0;
  SvgWriter svg_;
};

/// The ground with its grid.
void DrawFloor(Canvas& canvas);

/// Edges of all first, then all that is solid, so that obstacles that overlap become one; last the
/// frame of the plot.
void DrawObstacles(const World& world, Canvas& canvas);

/// Below the plot, at the right.
void DrawScaleBar(Canvas& canvas);

struct ModeLook {
  PathMode mode;
  std::string_view colour;
  std::string_view label;
};
inline constexpr std::array<ModeLook, 3> kModes = {
    {{PathMode::kDrivingToGoal, "#2468d6", "driving to the goal"},
     {PathMode::kFollowingWall, "#e07b1a", "following a wall"},
     {PathMode::kGoingToLeavePoint, "#139c8f", "going to the leave point"}}};

/// The path coloured by mode, with arrows along it.
void DrawPath(const std::vector<PathSample>& path, Canvas& canvas);

}  // namespace runnel::internal
