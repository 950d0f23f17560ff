#include "modules/types/algorithm/svg_writer.h"

#include <array>
#include <charconv>

namespace runnel {

namespace {

std::string Attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + Decimal(value) + "\"";
}

std::string Pair(Point2 point) { return Decimal(point.x) + "," + Decimal(point.y); }

std::string End(std::string_view style) { return " " + std::string(style) + "/>\n"; }

// As EscapedMarkup(), of which algorithms know nothing.
std::string EscapedXml(std::string_view text) {
  constexpr std::string_view kMeant = "&<>\"";
  constexpr std::array kNames{"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string escaped;
  for (const char character : text) {
    const std::size_t named = kMeant.find(character);
    escaped += named != std::string_view::npos ? kNames[named] : std::string(1, character);
  }
  return escaped;
}

}  // namespace

std::string Decimal(double number, int digits) {
  char text[64];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number, std::chars_format::fixed, digits);
  if (error != std::errc()) return "0";
  const std::string decimal(text, end);
  const bool is_zero = decimal.find_first_of("123456789") == std::string::npos;
  return is_zero && decimal.front() == '-' ? decimal.substr(1) : decimal;
}

void SvgWriter::Open(double width, double height) {
  text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + Attribute("width", width) + Attribute("height", height) +
          " viewBox=\"0 0 " + Decimal(width) + " " + Decimal(height) +
          "\" font-family=\"Helvetica, Arial, sans-serif\">\n";
}

void SvgWriter::Rectangle(Point2 corner, double width, double height, std::string_view style) {
  text_ += "<rect" + Attribute("x", corner.x) + Attribute("y", corner.y) + Attribute("width", width) +
           Attribute("height", height) + End(style);
}

void SvgWriter::Circle(Point2 centre, double radius, std::string_view style) {
  text_ += "<circle" + Attribute("cx", centre.x) + Attribute("cy", centre.y) + Attribute("r", radius) + End(style);
}

void SvgWriter::Line(Point2 from, Point2 to, std::string_view style) {
  text_ += "<line" + Attribute("x1", from.x) + Attribute("y1", from.y) + Attribute("x2", to.x) + Attribute("y2", to.y) +
           End(style);
}

void SvgWriter::Polyline(const std::vector<Point2>& points, std::string_view style) {
  text_ += "<polyline points=\"";
  for (std::size_t i = 0; i < points.size(); ++i) text_ += (i == 0 ? "" : " ") + Pair(points[i]);
  text_ += "\"" + End(style);
}

void SvgWriter::Rings(const std::vector<std::vector<Point2>>& rings, std::string_view style) {
  text_ += "<path fill-rule=\"evenodd\" d=\"";
  for (const std::vector<Point2>& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) text_ += (i == 0 ? "M" : " L") + Pair(ring[i]);
    text_ += "Z";
  }
  text_ += "\"" + End(style);
}

void SvgWriter::Text(Point2 place, std::string_view text, std::string_view style) {
  text_ += "<text" + Attribute("x", place.x) + Attribute("y", place.y) + " " + std::string(style) + ">" +
           EscapedXml(text) + "</text>\n";
}

}  // namespace runnel
