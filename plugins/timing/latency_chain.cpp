#include "plugins/timing/latency_chain.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/paths/path_search.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

namespace {

std::int64_t MeasuredAt(const Port& output) noexcept {
  std::int64_t measured = 0;
  output.VisitLatest(
      [&measured](const void*, ValueTimes times) { measured = times.timestamp.time_since_epoch().count(); });
  return measured;
}

FrameworkElement* RunnerOf(const Port& port) {
  FrameworkElement* at = port.parent();
  while (at != nullptr && at->FindAnnotation<Executable>() == nullptr) at = at->parent();
  return at != nullptr && at->life_cycle() != LifeCycle::kDeleted ? at : nullptr;
}

std::vector<Port*> OutputsOf(FrameworkElement& element) {
  std::vector<Port*> outputs;
  element.VisitAll<Port>([&](Port& port) {
    if (!port.is_proxy() && port.direction() == Port::Direction::kOutput) outputs.push_back(&port);
  });
  return outputs;
}

// The module's own output behind a port, which may be of a group, or an input.
Result<Port*> FindOutput(Runtime& runtime, const std::string& path) {
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
  if (!found) return found.error();
  Port& port = **found;
  if (!port.is_proxy() && port.direction() == Port::Direction::kOutput) return &port;
  const std::vector<Port*> sources = port.Sources();
  if (sources.size() == 1) return sources.front();
  return Error{.message = sources.empty() ? "nothing is connected to it" : "is fed by several outputs",
               .path = port.path(),
               .hint = "name an output"};
}

}  // namespace

void ChainSteps::Add(std::shared_ptr<LatencyChain> chain, std::size_t place) {
  const std::uint64_t publications = chain->points[place].output->publications();
  steps_.push_back({.chain = std::move(chain), .place = place, .publications = publications});
}

void ChainSteps::Begin() const noexcept {
  for (Step& step : steps_) {
    if (step.place == 0) continue;
    const LatencyChain::Point& point = step.chain->points[step.place - 1];
    if (step.place == 1 && step.chain->stops.front() == 0) {
      step.number = point.output->publications();
      step.measured = MeasuredAt(*point.output);
      continue;
    }
    // acquire: pairs with the release in End(): the time is that of this measurement, or of a later one.
    step.number = point.number.load(std::memory_order_acquire);
    step.measured = point.measured.load(std::memory_order_relaxed);
  }
}

void ChainSteps::End(Time within_task, TraceTrack* track) const noexcept {
  for (Step& step : steps_) {
    LatencyChain& chain = *step.chain;
    LatencyChain::Point& point = chain.points[step.place];
    const std::uint64_t before = std::exchange(step.publications, point.output->publications());
    if (step.publications <= before) continue;  // fewer: the channel of another one, taken over
    const bool is_first = step.place == 0;
    if (is_first) {
      step.number = step.publications;
      step.measured = MeasuredAt(*point.output);
    }
    // What nothing goes back to, and what another value has gone back to before, counts for nothing.
    if (step.number == 0 || step.number == std::exchange(step.last_number, step.number)) continue;
    point.measured.store(step.measured, std::memory_order_relaxed);
    point.number.store(step.number, std::memory_order_release);
    const bool is_last = step.place + 1 == chain.points.size();
    if (is_last) chain.meter->Add(chain.clock->Now() - Time(Duration(step.measured)));
    if (track != nullptr) {
      using Arrow = TraceEvent::Arrow;
      track->NoteArrow(is_first  ? Arrow::kBegins
                       : is_last ? Arrow::kEnds
                                 : Arrow::kPasses,
                       chain.name, step.number, within_task);
    }
  }
}

Result<DataPath> FindDataPath(FrameworkElement& root, const LatencyRequest& request) {
  const auto from = FindOutput(root.runtime(), request.from);
  if (!from) return from.error();
  const auto to = FindOutput(root.runtime(), request.to);
  if (!to) return to.error();
  FrameworkElement* const target = RunnerOf(**to);
  if (*from == *to || target == nullptr) {
    return Error{.message = "is not computed from " + (*from)->path() + " by any module", .path = (*to)->path()};
  }
  // Breadth first, from output to output.
  std::map<const Port*, const Port*> before{{*from, nullptr}};
  std::deque<const Port*> next{*from};
  for (; !next.empty() && !before.contains(*to); next.pop_front()) {
    for (const Port* input : next.front()->Sinks()) {
      FrameworkElement* const reader = RunnerOf(*input);
      if (reader == nullptr) continue;
      for (const Port* output : OutputsOf(*reader)) {
        if (before.emplace(output, next.front()).second) next.push_back(output);
      }
    }
  }
  if (!before.contains(*to)) {
    return Error{.message = "no data flow from " + (*from)->path() + " to here", .path = (*to)->path()};
  }
  DataPath path;
  for (const Port* at = *to; at != nullptr; at = before[at]) path.stops.push_back({RunnerOf(*at), at});
  std::ranges::reverse(path.stops);
  return path;
}

}  // namespace runnel
