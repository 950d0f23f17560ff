#include <cmath>
#include <utility>

#include "plugins/inspector/structure_mirror.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

// Four digits: what differs in the fifth is no news.
double Rounded(double number) {
  if (number == 0) return 0;
  const double scale = std::pow(10.0, 3 - std::floor(std::log10(number)));
  return std::round(number * scale) / scale;
}

double Milliseconds(Duration duration) { return Rounded(ToSeconds(duration) * 1e3); }

void AppendThread(const CycleStatistics& statistics, std::string& text) {
  JsonObject json(text);
  json.Add("cycles", statistics.cycles);
  json.Add("period_ms", Milliseconds(statistics.period_mean));
  json.Add("jitter_ms", Milliseconds(statistics.jitter_mean));
  json.Add("overruns", statistics.overruns);
  JsonObject(json.Key("duration_ms"))
      .Add("mean", Milliseconds(statistics.execution_mean))
      .Add("max", Milliseconds(statistics.execution_max));
}

void AppendPorts(const CountSample& before, const CountSample& now, std::vector<ToldRate>& told, std::string& text) {
  const std::vector<std::string>& paths = now.of->ports;
  if (told.size() != paths.size()) told.assign(paths.size(), {});
  JsonObject json(text);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (told[i].told == ToldRate::kNever) told[i].rate.Look(before.publications[i], before.time);
    const double rate = Rounded(told[i].rate.Look(now.publications[i], now.time));
    if (std::exchange(told[i].told, rate) != rate) json.Add(paths[i], rate);
  }
}

void AppendThreads(const CountSample& before, const CountSample& now, std::string& text) {
  const std::vector<std::string>& paths = now.of->threads;
  JsonObject json(text);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (now.threads[i].cycles == before.threads[i].cycles) continue;
    AppendThread(now.threads[i], json.Key(paths[i]));
  }
}

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
  AppendList(latency.modules, json.Key("modules"), AppendJsonString);
  AddTimes(latency.times, json);
}

}  // namespace

std::string RateMessage(const CountSample& before, const CountSample& now, double time, std::vector<ToldRate>& told) {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "rates").Add("time", time);
    AppendPorts(before, now, told, json.Key("ports"));
    AppendThreads(before, now, json.Key("threads"));
  });
}

std::string ProfileMessage(const Profile& profile, std::optional<Duration> measured) {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "profile").Add("on", measured.has_value());
    json.Add("seconds", ToSeconds(measured.value_or(Duration{})));
    AppendList(profile.tasks, json.Key("tasks"), AppendTask);
    AppendList(profile.latencies, json.Key("latencies"), AppendLatency);
  });
}

}  // namespace runnel::internal
