#include <algorithm>

#include "modules/simulation/algorithm/internal/drawing.h"

namespace runnel::internal {

namespace {

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
  canvas.svg().OpenGroup(
      Style({"class", is_casing ? "casing" : "path", "fill", "none", "stroke-linejoin", "round",
             "stroke-linecap", "round", "stroke-width", is_casing ? "6" : "3"}));
  std::size_t first = 0;
  for (std::size_t i = 1; i <= path.size(); ++i) {
    if (i < path.size() && path[i].mode == path[first].mode) continue;
    std::vector<Point2> line;
    for (std::size_t p = first; p < std::min(i + 1, path.size()); ++p) {
      line.push_back(canvas.Pixel(path[p].position));
    }
    canvas.svg().Polyline(line,
                          Style({"stroke", is_casing ? "#ffffff" : ColourOf(path[first].mode)}));
    first = i;
  }
  canvas.svg().CloseGroup();
}

void DrawArrow(Canvas& canvas, Point2 place, double direction, std::string_view colour) {
  const Pose2 pose = {place.x, place.y, direction};
  const double size = 6.5 / canvas.scale();
  canvas.svg().Rings(
      {canvas.Pixels({ToWorld(pose, {size, 0}), ToWorld(pose, {-size, 0.8 * size}),
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
      DrawArrow(canvas, path[i - 1].position + (to_next / length) * step, Direction(step),
                ColourOf(path[i - 1].mode));
    }
    to_next -= length;
  }
}

}  // namespace

void DrawPath(const std::vector<PathSample>& path, Canvas& canvas) {
  const std::vector<PathSample> thinned = Thinned(path, canvas.scale());
  DrawLines(thinned, canvas, true);
  DrawLines(thinned, canvas, false);
  DrawArrows(thinned, canvas);
}

}  // namespace runnel::internal
