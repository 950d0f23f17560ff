#include "bench/report/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace runnel::bench {

std::string Rounded(double value) {
  if (value == 0) return "0";
  const int digits_before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  char text[40];
  std::snprintf(text, sizeof(text), "%.*f", std::clamp(3 - digits_before, 0, 6), value);
  return text;
}

namespace {

struct Scaled {
  double value;
  std::string unit;
};

Scaled Scale(double value, const std::string& unit, double largest) {
  static const std::map<std::string, std::string> thousandfold = {
      {"ns", "us"}, {"us", "ms"}, {"ms", "s"}, {"B", "kB"}, {"kB", "MB"}};
  std::string in = unit;
  for (auto next = thousandfold.find(in); value >= largest && next != thousandfold.end();
       next = thousandfold.find(in)) {
    value /= 1000;
    in = next->second;
  }
  return {value, in};
}

}  // namespace

std::string WithUnit(double value, const std::string& unit) {
  const Scaled scaled = Scale(value, unit, 10'000);
  return Rounded(scaled.value) + " " + scaled.unit;
}

std::string Short(double value) {
  char text[40];
  if (value >= 1e6) {
    std::snprintf(text, sizeof(text), "%gM", value * 1e-6);
  } else {
    std::snprintf(text, sizeof(text), value >= 1e4 ? "%gk" : "%g", value >= 1e4 ? value * 1e-3 : value);
  }
  return text;
}

std::string ShortWithUnit(double value, const std::string& unit) {
  const Scaled scaled = Scale(value, unit, 1'000);
  return Short(scaled.value) + " " + scaled.unit;
}

std::string TextTable::ToString() const {
  std::vector<std::size_t> widths;
  for (const auto& line : lines_) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (std::size_t number = 0; number < lines_.size(); ++number) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::string cell = i < lines_[number].size() ? lines_[number][i] : "";
      text += "| " + cell + std::string(widths[i] - cell.size() + 1, ' ');
    }
    text += "|\n";
    if (number > 0) continue;
    for (const std::size_t width : widths) text += "|" + std::string(width + 2, '-');
    text += "|\n";
  }
  return text;
}

}  // namespace runnel::bench
