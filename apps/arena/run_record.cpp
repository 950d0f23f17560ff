#include "apps/arena/run_record.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace runnel {

static void to_json(nlohmann::ordered_json& json, const Point2& point) { json = {point.x, point.y}; }
static void from_json(const nlohmann::ordered_json& json, Point2& point) { point = {json.at(0), json.at(1)}; }

}  // namespace runnel

namespace runnel::arena {

namespace {

using Json = nlohmann::ordered_json;

Json ListOf(const std::vector<PathSample>& path) {
  Json list = Json::array();
  for (const PathSample& sample : path) {
    list.push_back({sample.time, sample.position.x, sample.position.y, sample.heading});
  }
  return list;
}

std::vector<PathSample> PathOf(const Json& list, const Json& modes) {
  std::vector<PathSample> path;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& sample = list.at(i);
    path.push_back({.position = {sample.at(1).get<double>(), sample.at(2).get<double>()},
                    .mode = static_cast<PathMode>(std::clamp(modes.at(i).get<int>(), 0, 2)),
                    .heading = sample.at(3).get<double>(),
                    .time = sample.at(0).get<double>()});
  }
  return path;
}

RunResult ResultOf(const Json& object) {
  return {.outcome = object.at("outcome").get<std::string>(),
          .remark = object.at("remark").get<std::string>(),
          .path_length = object.at("path_length_m").get<double>(),
          .simulated_time = object.at("sim_time_s").get<double>(),
          .cycles = object.at("cycles").get<std::uint64_t>(),
          .robot_radius = object.at("robot_radius_m").get<double>(),
          .hits = object.at("hits"),
          .leaves = object.at("leaves"),
          .path = PathOf(object.at("path"), object.at("modes"))};
}

Json ObjectOf(const RunRecord& record) {
  const RunResult& result = record.result;
  const bool is_right = result.outcome == (record.shortest_path ? "reached" : "unreachable");
  const bool has_ratio = is_right && record.shortest_path.value_or(0.0) > 0.0;
  return {{"world", record.key.world},
          {"variant", record.key.variant},
          {"sensor", record.key.sensor},
          {"direction", record.key.direction},
          {"seed", record.key.seed},
          {"noise_m", record.noise},
          {"outcome", result.outcome},
          {"remark", result.remark},
          {"is_right", is_right},
          {"path_length_m", result.path_length},
          {"shortest_path_m", record.shortest_path ? Json(*record.shortest_path) : Json()},
          {"ratio", has_ratio ? Json(result.path_length / *record.shortest_path) : Json()},
          {"sim_time_s", result.simulated_time},
          {"wall_time_s", record.wall_time},
          {"cycles", result.cycles},
          {"hits", result.hits},
          {"leaves", result.leaves},
          {"path", ListOf(result.path)}};
}

// A remark may hold what a program wrote before it crashed, in whatever encoding.
std::string TextOf(const Json& object) { return object.dump(-1, ' ', false, Json::error_handler_t::replace); }

template <typename Read>
auto Attempt(std::string_view text, const Read& read) -> Result<decltype(read(Json()))> {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& exception) {
    return Error{.message = exception.what()};
  }
}

}  // namespace

std::string TextOf(const RunKey& key) {
  return key.world + " " + key.variant + " " + key.sensor + " " + key.direction + " " + std::to_string(key.seed);
}

std::string FileNameOf(const RunKey& key) {
  std::string name = TextOf(key);
  std::ranges::replace(name, ' ', '-');
  std::ranges::replace(name, '/', '_');
  return name;
}

Result<RunResult> ParseRunResult(std::string_view text) { return Attempt(text, ResultOf); }

std::string JsonOf(const RunRecord& record) { return TextOf(ObjectOf(record)); }

std::string JsonOf(const std::vector<RunRecord>& records) {
  std::string list = "[";
  for (const RunRecord& record : records) {
    list += (list.size() == 1 ? "\n" : ",\n") + JsonOf(record);
  }
  return list + "\n]\n";
}

std::string JournalLineOf(const RunRecord& record, std::string_view made_of) {
  Json object = ObjectOf(record);
  object["robot_radius_m"] = record.result.robot_radius;
  object["processor_time_s"] = record.processor_time;
  Json& modes = object["modes"] = Json::array();
  for (const PathSample& sample : record.result.path) modes.push_back(static_cast<int>(sample.mode));
  object["has_ended_by_itself"] = record.has_ended_by_itself;
  object["made_of"] = made_of;
  return TextOf(object);
}

Result<JournalEntry> ParseJournalLine(std::string_view line) {
  return Attempt(line, [](const Json& object) {
    const Json& shortest = object.at("shortest_path_m");
    return JournalEntry{
        .record = {.key = {.world = object.at("world").get<std::string>(),
                           .variant = object.at("variant").get<std::string>(),
                           .sensor = object.at("sensor").get<std::string>(),
                           .direction = object.at("direction").get<std::string>(),
                           .seed = object.at("seed").get<std::uint64_t>()},
                   .result = ResultOf(object),
                   .wall_time = object.at("wall_time_s").get<double>(),
                   .processor_time = object.at("processor_time_s").get<double>(),
                   .has_ended_by_itself = object.at("has_ended_by_itself").get<bool>(),
                   .noise = object.at("noise_m").get<double>(),
                   .shortest_path = shortest.is_null() ? std::nullopt : std::optional(shortest.get<double>())},
        .made_of = object.at("made_of").get<std::string>()};
  });
}

}  // namespace runnel::arena
