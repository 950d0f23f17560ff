#include "plugins/inspector/internal/rate_message.h"

#include <cmath>

#include "plugins/inspector/internal/json_object.h"

namespace runnel::internal {

namespace {

constexpr double kNever = -1;

// Four digits: what differs in the fifth is no news.
double Rounded(double number) {
  if (number == 0) return 0;
  const double scale = std::pow(10.0, 3 - std::floor(std::log10(number)));
  return std::round(number * scale) / scale;
}

double Milliseconds(Duration duration) { return Rounded(ToSeconds(duration) * 1e3); }

void AppendThread(const CycleStatistics& statistics, std::string& text) {
  JsonObject json(text);
  json.Whole("cycles", statistics.cycles);
  json.Number("period_ms", Milliseconds(statistics.period_mean));
  JsonObject(json.Key("duration_ms"))
      .Number("mean", Milliseconds(statistics.execution_mean))
      .Number("max", Milliseconds(statistics.execution_max));
  json.Number("jitter_ms", Milliseconds(statistics.jitter_mean));
  json.Whole("overruns", statistics.overruns);
}

// Paths are keys here.
std::string& KeyOf(const std::string& path, JsonObject& json) {
  std::string quoted;
  AppendQuoted(path, quoted);
  return json.Key(std::string_view(quoted).substr(1, quoted.size() - 2));
}

void AppendPorts(const CountSample& before, const CountSample& now, std::vector<double>& told,
                 std::string& text) {
  const std::vector<std::string>& paths = now.of->ports;
  if (told.size() != paths.size()) told.assign(paths.size(), kNever);
  const double seconds = ToSeconds(now.time - before.time);
  JsonObject json(text);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    // A port that was made anew counts from 0 again.
    const std::uint64_t count = now.publications[i];
    const std::uint64_t passed =
        count >= before.publications[i] ? count - before.publications[i] : count;
    const double rate = seconds > 0 ? Rounded(static_cast<double>(passed) / seconds) : 0;
    if (rate == told[i]) continue;
    told[i] = rate;
    AppendNumber(rate, KeyOf(paths[i], json));
  }
}

void AppendThreads(const CountSample& before, const CountSample& now, std::string& text) {
  const std::vector<std::string>& paths = now.of->threads;
  JsonObject json(text);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (now.threads[i].cycles == before.threads[i].cycles) continue;
    AppendThread(now.threads[i], KeyOf(paths[i], json));
  }
}

}  // namespace

std::string RateMessage(const CountSample& before, const CountSample& now, double time,
                        std::vector<double>& told) {
  std::string text;
  {
    JsonObject json(text);
    json.Text("op", "rates").Number("time", time);
    AppendPorts(before, now, told, json.Key("ports"));
    AppendThreads(before, now, json.Key("threads"));
    json.Json("modules", "{}");
  }
  return text;
}

}  // namespace runnel::internal
