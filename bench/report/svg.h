#pragma once

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace runnel::bench {

/// A drawing in SVG, in pixels from the upper left corner, on white.
class Svg {
 public:
  enum class Anchor { kStart, kMiddle, kEnd };
  struct Point {
    double x;
    double y;
  };

  Svg(double width, double height);

  void Rectangle(Point corner, double width, double height, const std::string& colour);
  void Line(Point from, Point to, const std::string& colour, double width = 1);
  void Polyline(const std::vector<Point>& points, const std::string& colour, double width);
  void Dot(Point centre, double radius, const std::string& colour);
  void Text(Point at, const std::string& text, Anchor anchor = Anchor::kStart, int size = 12,
            const std::string& colour = "#222");

  [[nodiscard]] std::string ToString() const;

 private:
  std::ostringstream content_;
};

}  // namespace runnel::bench
