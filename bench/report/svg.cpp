#include "bench/report/svg.h"

#include "core/base/markup.h"

namespace runnel::bench {

Svg::Svg(double width, double height) {
  content_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\""
           << height << "\" viewBox=\"0 0 " << width << ' ' << height
           << "\" font-family=\"sans-serif\">\n";
  Rectangle({0, 0}, width, height, "#fff");
}

void Svg::Rectangle(Point corner, double width, double height, const std::string& colour) {
  content_ << "<rect x=\"" << corner.x << "\" y=\"" << corner.y << "\" width=\"" << width
           << "\" height=\"" << height << "\" fill=\"" << colour << "\"/>\n";
}

void Svg::Line(Point from, Point to, const std::string& colour, double width) {
  Polyline({from, to}, colour, width);
}

void Svg::Polyline(const std::vector<Point>& points, const std::string& colour, double width) {
  content_ << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"" << width
           << "\" points=\"";
  for (const Point& point : points) content_ << point.x << ',' << point.y << ' ';
  content_ << "\"/>\n";
}

void Svg::Dot(Point centre, double radius, const std::string& colour) {
  content_ << "<circle cx=\"" << centre.x << "\" cy=\"" << centre.y << "\" r=\"" << radius
           << "\" fill=\"" << colour << "\"/>\n";
}

void Svg::Text(Point at, const std::string& text, Anchor anchor, int size,
               const std::string& colour) {
  const char* name = anchor == Anchor::kStart    ? "start"
                     : anchor == Anchor::kMiddle ? "middle"
                                                 : "end";
  content_ << "<text x=\"" << at.x << "\" y=\"" << at.y << "\" text-anchor=\"" << name
           << "\" font-size=\"" << size << "\" fill=\"" << colour << "\">" << EscapedMarkup(text)
           << "</text>\n";
}

std::string Svg::ToString() const { return content_.str() + "</svg>\n"; }

}  // namespace runnel::bench
