#include <cmath>

#include "plugins/inspector/structure_mirror.h"
#include "plugins/values/json_writer.h"

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
  json.Add("cycles", statistics.cycles);
  json.Add("period_ms", Milliseconds(statistics.period_mean));
  json.Add("jitter_ms", Milliseconds(statistics.jitter_mean));
  json.Add("overruns", statistics.overruns);
  JsonObject(json.Key("duration_ms"))
      .Add("mean", Milliseconds(statistics.execution_mean))
      .Add("max", Milliseconds(statistics.execution_max));
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
    json.Add(paths[i], rate);
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

}  // namespace

std::string RateMessage(const CountSample& before, const CountSample& now, double time,
                        std::vector<double>& told) {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "rates").Add("time", time);
    AppendPorts(before, now, told, json.Key("ports"));
    AppendThreads(before, now, json.Key("threads"));
  });
}

}  // namespace runnel::internal
