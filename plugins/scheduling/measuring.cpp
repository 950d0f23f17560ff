// How long tasks and chains of modules take: what a Scheduler measures if it is asked to.

#include <mutex>
#include <utility>

#include "core/paths/path_search.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

void Scheduler::UpdateInstruments() {
  std::uint8_t instruments = options_.tracer != nullptr ? Instruments::kTrace : 0;
  if (options_.notes_running_tasks || cycle_watchdog_.has_rules()) {
    instruments |= Instruments::kRunning;
  }
  if (profile_began_) instruments |= Instruments::kProfile;
  if (!chains_.empty()) instruments |= Instruments::kLatency;
  for (const auto& runner : runners_) runner->set_instruments(instruments);
}

// What is measured from now on begins at nothing.
void Scheduler::SetProfiled(bool is_profiled) {
  const std::lock_guard lock(runtime_.structure_mutex());
  is_profiled_ = is_profiled;
  BeginOrEndProfile();
}

Scheduler::ProfileUse::ProfileUse(Scheduler& scheduler) : scheduler_(scheduler) {
  const std::lock_guard lock(scheduler_.runtime_.structure_mutex());
  ++scheduler_.profile_uses_;
  scheduler_.BeginOrEndProfile();
}

// Whoever looked has gone, and waits for no lock. What has it brings the schedule up to date.
Scheduler::ProfileUse::~ProfileUse() {
  --scheduler_.profile_uses_;
  const std::unique_lock lock(scheduler_.runtime_.structure_mutex(), std::try_to_lock);
  if (lock) scheduler_.BeginOrEndProfile();
}

void Scheduler::BeginOrEndProfile() {
  const bool measures = is_profiled_ || profile_uses_ > 0;
  if (measures && !profile_began_) {
    compiler_.ResetMeters();
    profile_began_ = machine_.Now();
  }
  if (!measures) profile_began_.reset();
  UpdateInstruments();
}

Profile Scheduler::ReadProfile() {
  const std::lock_guard lock(runtime_.structure_mutex());
  BringUpToDate();
  Profile profile;
  if (profile_began_) profile.tasks = compiler_.Tasks();
  profile.latencies = ReadLatencies();
  return profile;
}

std::optional<Duration> Scheduler::profiled_for() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  return profile_began_ ? std::optional(machine_.Now() - *profile_began_) : std::nullopt;
}

Result<void> Scheduler::AddLatency(const LatencyRequest& request) {
  const std::lock_guard lock(runtime_.structure_mutex());
  auto chain = MakeChain(request);
  if (!chain) return chain.error();
  for (const auto& each : chains_) {
    if (each->request == (*chain)->request) return {};
  }
  chains_.push_back(std::move(*chain));
  TieChains();
  return {};
}

Result<void> Scheduler::RemoveLatency(const LatencyRequest& request) {
  const std::lock_guard lock(runtime_.structure_mutex());
  // Paths may leave out what MakeChain() has put in.
  const PathSearch structure(runtime_);
  LatencyRequest whole = request;
  for (std::string* path : {&whole.from, &whole.to}) {
    if (const auto found = structure.FindPort(*path, PathKind::kOutput)) *path = (*found)->path();
  }
  if (std::erase_if(chains_, [&](const auto& each) { return each->request == whole; }) == 0) {
    return Error{.message = "no latency is measured from there to here", .path = whole.to};
  }
  TieChains();
  return {};
}

std::vector<Latency> Scheduler::ReadLatencies() {
  const std::lock_guard lock(runtime_.structure_mutex());
  std::vector<Latency> latencies;
  for (const auto& each : chains_) {
    latencies.push_back({each->request, each->modules, each->meter->times()});
  }
  return latencies;
}

void Scheduler::VisitThreadStatistics(const StatisticsVisitor& visit) const {
  for (const auto& runner : runners_) visit(runner->path(), runner->statistics());
}

// With full paths, so that one that is asked for twice is known again.
Result<std::shared_ptr<LatencyChain>> Scheduler::MakeChain(const LatencyRequest& request) {
  const auto path = FindDataPath(runtime_.root(), request);
  if (!path) return path.error();
  auto chain = std::make_shared<LatencyChain>();
  chain->request = {path->stops.front().output->path(), path->stops.back().output->path()};
  chain->clock = &runtime_.clock();
  chain->meter = std::make_shared<TaskMeter>();
  if (options_.tracer != nullptr) {
    chain->name = options_.tracer->NumberOf(chain->request.from + " to " + chain->request.to);
  }
  FollowPath(*path, *chain);
  return chain;
}

void Scheduler::FollowPath(const DataPath& path, LatencyChain& chain) {
  chain.modules.clear();
  chain.points = std::vector<LatencyChain::Point>(path.stops.size());
  chain.stops.clear();
  for (std::size_t i = 0; i < path.stops.size(); ++i) {
    chain.points[i].output = path.stops[i].output;
    FrameworkElement* const element = path.stops[i].element;
    chain.stops.push_back(element != nullptr ? element->id() : 0);
    if (element != nullptr) chain.modules.push_back(element->path());
  }
}

// Each chain anew, along the structure as it is now: cycles that are under way go on with what was before.
void Scheduler::FollowChains() {
  for (auto& chain : chains_) {
    auto next = std::make_shared<LatencyChain>();
    next->request = chain->request;
    next->name = chain->name;
    next->clock = chain->clock;
    next->meter = chain->meter;
    if (const auto path = FindDataPath(runtime_.root(), chain->request)) FollowPath(*path, *next);
    chain = std::move(next);
  }
  TieChains();
}

void Scheduler::TieChains() {
  std::map<std::uint64_t, std::unique_ptr<ChainSteps>> steps;
  for (const auto& chain : chains_) {
    for (std::size_t place = 0; place < chain->stops.size(); ++place) {
      if (chain->stops[place] == 0) continue;
      auto& of_element = steps[chain->stops[place]];
      if (!of_element) of_element = std::make_unique<ChainSteps>();
      of_element->Add(chain, place);
    }
  }
  compiler_.SetChains(std::move(steps));
  UpdateInstruments();
}

}  // namespace runnel
