#include "modules/simulation/referee.h"

#include <cmath>
#include <limits>

#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

void AppendNumber(double number, std::string& json) {
  AppendJsonNumber(std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN(), json);
}

void AppendPlace(Point2 point, std::string& json) {
  JsonArray place(json);
  AppendNumber(point.x, place.Next());
  AppendNumber(point.y, place.Next());
}

void AppendSample(const PathSample& sample, std::string& json) {
  JsonArray list(json);
  for (const double each : {sample.time, sample.position.x, sample.position.y, sample.heading}) {
    // To the micrometre, -radian or -second: more digits would say nothing and make a big file.
    AppendNumber(std::round(each * 1e6) / 1e6 + 0.0, list.Next());
  }
}

void AppendMode(const PathSample& sample, std::string& json) {
  AppendJsonNumber(static_cast<std::int64_t>(sample.mode), json);
}

}  // namespace

std::string JsonOf(const RunResult& result) {
  return JsonObjectText([&](JsonObject& object) {
           object.Add("outcome", result.outcome).Add("remark", result.remark);
           AppendNumber(result.path_length, object.Key("path_length_m"));
           AppendNumber(result.simulated_time, object.Key("sim_time_s"));
           object.Add("cycles", result.cycles);
           AppendNumber(result.robot_radius, object.Key("robot_radius_m"));
           AppendList(result.hits, object.Key("hits"), AppendPlace);
           AppendList(result.leaves, object.Key("leaves"), AppendPlace);
           AppendList(result.path, object.Key("path"), AppendSample);
           AppendList(result.path, object.Key("modes"), AppendMode);
         }) +
         "\n";
}

}  // namespace runnel
