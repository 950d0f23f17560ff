#include "plugins/values/watched_port.h"

#include <algorithm>

#include "core/port/input_base.h"

namespace runnel {

namespace {

constexpr int kMostLooks = 3;   // at a port that publishes meanwhile: not for ever
constexpr double kPeriods = 2;  // without a publication, and it publishes no more

std::uint64_t CountOf(const std::vector<const Port*>& ports) {
  std::uint64_t count = 0;
  for (const Port* port : ports) count += port->publications();
  return count;
}

// Inputs look at their stops by themselves.
std::vector<internal::PassedStop> StopsOf(const Port& port) {
  const bool looks_itself = !port.is_proxy() && port.direction() == Port::Direction::kInput;
  return looks_itself ? std::vector<internal::PassedStop>() : internal::PassedStops(port);
}

// The safe value is as new as the look.
bool Visit(const std::vector<const Port*>& sources, const std::vector<internal::PassedStop>& stops, const Clock& clock,
           const Port::Visitor& look) {
  const auto pass = [&](const void* value, ValueTimes times) {
    const auto holds = [&](const auto& each) { return !each.stop->LetsPass(times); };
    const auto stop = std::ranges::find_if(stops, holds);
    if (stop == stops.end()) return look(value, times);
    look(stop->safe_value.get(), ValueTimes::Of(clock.Now()));
  };
  if (std::ranges::any_of(sources, [&](const Port* source) { return source->VisitLatest(pass); })) return true;
  const auto stop = std::ranges::find_if(stops, [](const auto& each) { return each.stop->in_force(); });
  if (stop != stops.end()) look(stop->safe_value.get(), ValueTimes::Of(clock.Now()));
  return stop != stops.end();
}

// Changes whenever other values may pass.
std::int64_t BarOf(const std::vector<internal::PassedStop>& stops) {
  std::int64_t bar = StopSignal::kNever;
  for (const auto& each : stops) bar = std::max(bar, each.stop->bar());
  return bar;
}

// What changes when other values are read there, which may be as many as those before.
std::vector<std::uint64_t> IdsOf(Runtime& runtime, const Port& port) {
  std::vector<std::uint64_t> ids{port.id()};
  const auto add = [&](const Port& shows) {
    for (const Port* each : shows.ShownPorts()) ids.push_back(each->id());
  };
  add(port);
  for (const Port* from : port.incoming()) add(*from);
  if (port.is_set_by_hand() || port.is_set_by_hand(Port::Setter::kRule)) ids.push_back(runtime.revision());
  return ids;
}

}  // namespace

Publications Publications::Of(const Port& port) {
  Publications found;
  for (int looks = kMostLooks; looks > 0; --looks) {
    found.count = port.publications();
    port.VisitLatest([&](const void*, ValueTimes times) { found.newest = times.publication_time; });
    if (port.publications() == found.count) break;
  }
  return found;
}

double PublicationRate::Look(const Publications& publications, Time time) {
  if (publications.count < last_.count) last_ = {};  // the port was made anew
  if (!last_.newest) {
    rate_ = 0;
    last_ = publications;
  } else if (publications.count == last_.count) {
    if (rate_ == 0 || ToSeconds(time - *last_.newest) <= kPeriods / rate_) return rate_;
    rate_ = 0;
    last_ = {};
  } else if (publications.newest != last_.newest) {  // else more of one cycle
    const double seconds = ToSeconds(*publications.newest - *last_.newest);
    rate_ = seconds > 0 ? static_cast<double>(publications.count - last_.count) / seconds : 0;
    last_ = publications;
  }
  return rate_;
}

bool VisitShown(const Port& port, const Port::Visitor& look) {
  return Visit(port.ShownPorts(), StopsOf(port), port.runtime().clock(), look);
}

Result<void> WatchedPort::Find(Runtime& runtime) {
  sources_.clear();
  stops_.clear();
  input_ = nullptr;
  const auto found = runtime.root().Find(path_);
  if (!found) return found.error();
  const auto* const port = dynamic_cast<const Port*>(*found);
  if (port == nullptr) return Error{.message = "this is not a port", .path = path_};
  std::vector<std::uint64_t> ids = IdsOf(runtime, *port);
  if (ids != ids_) shown_.reset();  // of others: they count anew
  ids_ = std::move(ids);
  port_ = port;
  type_ = &port->type();
  input_ = dynamic_cast<const InputBase*>(port);
  sources_ = port->ShownPorts();
  stops_ = StopsOf(*port);
  clock_ = &runtime.clock();
  return {};
}

std::optional<std::uint64_t> WatchedPort::VisitIfNew(const Port::Visitor& look) {
  for (const Port* source : sources_) source->NoteLook();
  std::uint64_t count = CountOf(sources_);
  const std::int64_t bar = BarOf(stops_);
  if (shown_ == std::pair(count, bar)) return {};
  for (int looks = kMostLooks; looks > 0; --looks) {
    if (!Visit(sources_, stops_, *clock_, look)) return {};
    const std::uint64_t after = CountOf(sources_);
    if (after == count) break;
    // What was published meanwhile may have been shown, or not. After the last look, the count of before:
    // what may be shown twice is never missed.
    if (looks > 1) count = after;
  }
  shown_ = {count, bar};
  return count;
}

std::uint64_t WatchedPort::dropped() const noexcept { return input_ == nullptr ? 0 : input_->dropped(); }

}  // namespace runnel
