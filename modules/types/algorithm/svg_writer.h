#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "modules/types/algorithm/pose.h"

namespace runnel {

/// Two digits after the point, whatever the locale, and never "-0.00".
[[nodiscard]] std::string Decimal(double number, int digits = 2);

/// Writes shapes one after the other. Points are in pixels, x to the right, y down; `style` is more
/// attributes, as they stand in the file.
class SvgWriter {
 public:
  void Open(double width, double height);
  void Rectangle(Point2 corner, double width, double height, std::string_view style);
  void Circle(Point2 centre, double radius, std::string_view style);
  void Line(Point2 from, Point2 to, std::string_view style);
  void Polyline(const std::vector<Point2>& points, std::string_view style);
  /// Closed rings as one shape: rings within rings are holes.
  void Rings(const std::vector<std::vector<Point2>>& rings, std::string_view style);
  void Text(Point2 place, std::string_view text, std::string_view style);
  void OpenGroup(std::string_view style) { text_ += "<g " + std::string(style) + ">\n"; }
  void CloseGroup() { text_ += "</g>\n"; }
  /// Ends the file and gives it away.
  [[nodiscard]] std::string Close() { return std::exchange(text_, {}) + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace runnel
