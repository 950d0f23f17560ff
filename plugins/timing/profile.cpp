#include "plugins/timing/profile.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace runnel {

namespace {

double Microseconds(Duration duration) { return ToSeconds(duration) * 1e6; }
double Milliseconds(Duration duration) { return ToSeconds(duration) * 1e3; }

struct Row {
  const ProfiledTask* task;
  double share;
};

std::string TaskTable(const Profile& profile, Duration passed, const Profile& since) {
  std::map<std::pair<std::string, Phase>, Duration> before;
  for (const ProfiledTask& each : since.tasks) before[{each.path, each.phase}] = each.times.total;
  std::vector<Row> rows;
  std::size_t width = 6;
  for (const ProfiledTask& each : profile.tasks) {
    const auto known = before.find({each.path, each.phase});
    Duration added = each.times.total;
    if (known != before.end() && known->second <= added) added -= known->second;
    rows.push_back({&each, passed > Duration{} ? 100 * ToSeconds(added) / ToSeconds(passed) : 0});
    width = std::max(width, each.thread.size());
  }
  std::ranges::stable_sort(rows, std::ranges::greater{}, &Row::share);
  std::string text = fmt::format("{:>7} {:>10} {:>10} {:>10} {:>10} {:>11} {:>5}  {:<{}}  module\n", "share/%", "runs",
                                 "last/us", "mean/us", "max/us", "total/ms", "order", "thread", width);
  for (const auto& [task, share] : rows) {
    const TaskTimes& times = task->times;
    text += fmt::format("{:7.2f} {:10} {:10.1f} {:10.1f} {:10.1f} {:11.3f} {:5}  {:<{}}  {}\n", share, times.runs,
                        Microseconds(times.last), Microseconds(times.mean()), Microseconds(times.max),
                        Milliseconds(times.total), task->order, task->thread, width, task->name());
  }
  return text;
}

std::string LatencyText(const Latency& latency) {
  const TaskTimes& times = latency.times;
  std::string way;
  for (const std::string& each : latency.modules) way += (way.empty() ? " by way of " : ", ") + each;
  return fmt::format("latency from {} to {}{}: ", latency.request.from, latency.request.to,
                     way.empty() ? ", between which there is no data flow now" : way) +
         fmt::format("last {:.3f} ms, mean {:.3f} ms, max {:.3f} ms, of {} measurements\n", Milliseconds(times.last),
                     Milliseconds(times.mean()), Milliseconds(times.max), times.runs);
}

}  // namespace

std::string ProfiledTask::name() const {
  constexpr std::array kPhases{" sense", "", " control"};
  return path + kPhases.at(static_cast<std::size_t>(phase));
}

std::string ProfileText(const Profile& profile, Duration passed, const Profile& since) {
  std::string text = profile.tasks.empty() ? "" : TaskTable(profile, passed, since);
  for (const Latency& each : profile.latencies) text += LatencyText(each);
  return text;
}

}  // namespace runnel
