#include "plugins/inspector/structure_mirror.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

double Microseconds(Duration duration) { return ToSeconds(duration) * 1e6; }

void AddTimes(const TaskTimes& times, JsonObject& json) {
  json.Add("runs", times.runs).Add("last_us", Microseconds(times.last));
  json.Add("mean_us", Microseconds(times.mean())).Add("max_us", Microseconds(times.max));
  json.Add("total_us", Microseconds(times.total));
}

void AppendTask(const ProfiledTask& task, std::string& text) {
  JsonObject json(text);
  json.Add("path", task.path).Add("name", task.name()).Add("thread", task.thread);
  json.Add("order", task.order);
  AddTimes(task.times, json);
}

void AppendLatency(const Latency& latency, std::string& text) {
  JsonObject json(text);
  json.Add("from", latency.request.from).Add("to", latency.request.to);
  AppendList(latency.modules, json.Key("modules"),
             [](const std::string& path, std::string& to) { AppendJsonString(path, to); });
  AddTimes(latency.times, json);
}

}  // namespace

std::string ProfileMessage(const Profile& profile, std::optional<Duration> measured) {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "profile").Add("on", measured.has_value());
    json.Add("seconds", ToSeconds(measured.value_or(Duration{})));
    AppendList(profile.tasks, json.Key("tasks"), AppendTask);
    AppendList(profile.latencies, json.Key("latencies"), AppendLatency);
  });
}

}  // namespace runnel::internal
