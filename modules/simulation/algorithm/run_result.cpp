#include "modules/simulation/algorithm/run_result.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace runnel {

namespace {

std::string Number(double value) {
  if (!std::isfinite(value)) return "null";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') {
      quoted += {'\\', character};
    } else if (static_cast<unsigned char>(character) < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(character));
      quoted += escape;
    } else {
      quoted += character;
    }
  }
  return quoted + "\"";
}

template <typename Items, typename Text>
std::string List(const Items& items, const Text& text) {
  std::string list = "[";
  for (const auto& item : items) list += (list.size() == 1 ? "" : ",") + text(item);
  return list + "]";
}

std::string PlaceText(Point2 point) { return "[" + Number(point.x) + "," + Number(point.y) + "]"; }

/// To the micrometre, -radian or -second: more digits would say nothing and make a big file.
std::string Rounded(double value) { return Number(std::round(value * 1e6) / 1e6 + 0.0); }

std::string SampleText(const PathSample& sample) {
  return "[" + Rounded(sample.time) + "," + Rounded(sample.position.x) + "," +
         Rounded(sample.position.y) + "," + Rounded(sample.heading) + "]";
}

std::string ModeText(const PathSample& sample) {
  return std::to_string(static_cast<int>(sample.mode));
}

}  // namespace

std::vector<PathSample> ThinnedPath(const std::vector<PathSample>& path, double step) {
  std::vector<PathSample> thinned;
  for (const PathSample& sample : path) {
    if (thinned.empty() || Distance(thinned.back().position, sample.position) >= step) {
      thinned.push_back(sample);
    }
  }
  if (!path.empty() && thinned.back().time < path.back().time) thinned.push_back(path.back());
  return thinned;
}

std::string JsonOf(const RunResult& result) {
  return "{\"outcome\":" + Quoted(result.outcome) + ",\"remark\":" + Quoted(result.remark) +
         ",\"path_length_m\":" + Number(result.path_length) +
         ",\"sim_time_s\":" + Number(result.simulated_time) +
         ",\"cycles\":" + std::to_string(result.cycles) +
         ",\"robot_radius_m\":" + Number(result.robot_radius) +
         ",\"hits\":" + List(result.hits, PlaceText) +
         ",\"leaves\":" + List(result.leaves, PlaceText) +
         ",\"path\":" + List(result.path, SampleText) +
         ",\"modes\":" + List(result.path, ModeText) + "}\n";
}

}  // namespace runnel
