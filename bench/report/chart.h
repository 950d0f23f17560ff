#pragma once

#include <string>
#include <vector>

#include "modules/types/algorithm/svg_writer.h"

namespace runnel::bench {

/// A drawing on white, with the styles that all charts share. Places are in pixels from the upper left
/// corner.
class Chart {
 public:
  enum class Anchor { kStart, kMiddle, kEnd };

  Chart(double width, double height);

  void Rectangle(Point2 corner, double width, double height, const std::string& colour);
  void Polyline(const std::vector<Point2>& points, const std::string& colour, double width = 1);
  void Dot(Point2 centre, double radius, const std::string& colour);
  void Text(Point2 at, const std::string& text, Anchor anchor = Anchor::kStart, int size = 12,
            const std::string& colour = "#222");

  /// Ends the drawing and gives it away.
  [[nodiscard]] std::string Close() { return svg_.Close(); }

 private:
  SvgWriter svg_;
};

}  // namespace runnel::bench
