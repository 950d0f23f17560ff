#include "modules/simulation/run_result_json.h"

#include <cmath>
#include <limits>

#include "plugins/json_values/json_writer.h"

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

template <typename Items, typename Append>
void AppendList(const Items& items, const Append& append, std::string& json) {
  JsonArray list(json);
  for (const auto& item : items) append(item, list.Next());
}

}  // namespace

std::string JsonOf(const RunResult& result) {
  std::string json;
  {
    JsonObject object(json);
    object.Add("outcome", result.outcome);
    object.Add("remark", result.remark);
    AppendNumber(result.path_length, object.Key("path_length_m"));
    AppendNumber(result.simulated_time, object.Key("sim_time_s"));
    object.Add("cycles", result.cycles);
    AppendNumber(result.robot_radius, object.Key("robot_radius_m"));
    AppendList(result.hits, AppendPlace, object.Key("hits"));
    AppendList(result.leaves, AppendPlace, object.Key("leaves"));
    AppendList(result.path, AppendSample, object.Key("path"));
    AppendList(result.path, AppendMode, object.Key("modes"));
  }
  return json + "\n";
}

}  // namespace runnel
