#include "plugins/supervision/watches.h"

#include <algorithm>
#include <utility>

#include "core/base/clock.h"
#include "core/element/configurable.h"
#include "core/port/driving_ports.h"
#include "core/port/input_base.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel::internal {

namespace {

constexpr Duration kShortestWait = std::chrono::milliseconds(1);

// What has been done here, and told, of the port.
struct RestMark final : Annotation {
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<RestMark>(*this);
  }
  std::optional<Time> rested;  // the value in the slot of rules is of here: when its source was last seen at rest
  bool is_unreached = false;
  bool is_ahead_told = false;
};

// Something is, or was, connected to the input.
struct FedMark final : Annotation {
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override { return std::make_unique<FedMark>(); }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
};

const RestMark* MarkOf(const Port& port) { return port.FindAnnotation<RestMark>(); }

RestMark& Mark(Port& port) {
  auto* const mark = port.FindAnnotation<RestMark>();
  return mark != nullptr ? *mark : port.Annotate(std::make_unique<RestMark>());
}

bool HasPublishedSince(const Port& source, Time since) {
  bool has_published = false;
  source.VisitLatest(
      [&](const void*, ValueTimes times) { has_published = times.publication_time > since; });
  return has_published;
}

std::string WhyAtRest(const std::vector<Port*>& ports, const Scheduler& scheduler, Duration patience) {
  std::string why;
  for (const Port* each : ports) {
    if (why.empty()) why = scheduler.WhyAtRest(*each, patience);
  }
  return why;
}

}  // namespace

StaleWatch::Turn StaleWatch::Look(Runtime& runtime, Time now) {
  if (!heard_) heard_ = now;  // what has never come is missing from now on
  Hear(runtime);
  const Turn turn = Judge(now);
  next_look_ = is_stale_
                   ? now + std::max(std::min(rule_->after, rule_->fresh_after) / 4, kShortestWait)
                   : SaturatingSum(SaturatingSum(*heard_, rule_->after), Duration(1));
  return turn;
}

// Counted from the measurement: what is old when it comes is stale. An output that is gone is silent.
void StaleWatch::Hear(Runtime& runtime) {
  for (const std::string& path : outputs_) {
    const auto found = runtime.root().Find(path);
    const auto* const port = found ? dynamic_cast<const Port*>(*found) : nullptr;
    if (port == nullptr) continue;
    port->VisitLatest([&](const void*, ValueTimes times) { heard_ = std::max(*heard_, times.timestamp); });
  }
}

StaleWatch::Turn StaleWatch::Judge(Time now) {
  const bool is_silent = now - *heard_ > rule_->after;
  if (!is_stale_) {
    is_stale_ = is_silent;
    return is_silent ? Turn::kStale : Turn::kNone;
  }
  if (is_silent) {
    well_since_.reset();
    return Turn::kNone;
  }
  if (!well_since_) well_since_ = *heard_;
  if (*heard_ - *well_since_ < rule_->fresh_after) return Turn::kNone;
  well_since_.reset();
  is_stale_ = false;
  return Turn::kFresh;
}

void Standstill::Look(Runtime& runtime, const Scheduler& scheduler, Time now, const Tell& tell) {
  if (std::exchange(revision_, runtime.revision()) != runtime.revision()) {
    driven_.clear();
    outputs_.clear();
    runtime.root().Visit([this](FrameworkElement& element) {
      auto* const port = dynamic_cast<Port*>(&element);
      if (port != nullptr && (port->is_driving() || MarkOf(*port) != nullptr)) driven_.emplace_back(*port);
      if (port != nullptr && port->direction() == Port::Direction::kOutput && (MarkOf(*port) == nullptr || !MarkOf(*port)->is_ahead_told))
        outputs_.push_back(port);
    });
  }
  for (const Driven& each : driven_) {
    LookAtReaders(each, scheduler, tell);
    LookAtSources(each, scheduler, now, tell);
  }
  std::erase_if(outputs_, [&](Port* each) {
    if (!each->stamps_ahead()) return false;
    Mark(*each).is_ahead_told = true;
    tell(*each, "bears times of measurement that are still to come; they count as the time of publication", false);
    return true;
  });
}

Standstill::Driven::Driven(Port& driving) : port(&driving), sources(driving.Sources()), sinks(driving.Sinks()) {
  const auto* const input = dynamic_cast<const InputBase*>(port);
  LookUpstream(*port, input != nullptr && input->ageing() == Ageing::kTimesOut, *this);
}

// Over modules that pass on what they get, as far as nobody asks how old it is; what sets parameters there does not grow old.
void Standstill::LookUpstream(const Port& port, bool times_out, Driven& driven) {
  for (Port* source : port.Sources()) {
    if (!driven.seen.insert(source).second) continue;
    if (&port == driven.port || !times_out) driven.upstream.push_back(source);
    LookAtParameters(*source, driven);
    std::vector<const Port*> cut_off;
    bool is_fed = false;
    VisitPassing(*source, Port::Direction::kInput, [&](Port& each) {
      const auto* const input = dynamic_cast<const InputBase*>(&each);
      const bool ages = times_out || (input != nullptr && input->ageing() != Ageing::kUnspecified);
      const bool is_by_hand = each.is_set_by_hand(Port::Setter::kPerson);  // whatever comes there does not count
      const bool is_bound = is_by_hand || !each.Sources().empty();
      if (is_bound) each.Annotate(std::make_unique<FedMark>());
      is_fed = is_fed || is_bound;
      if (!ages && !is_bound && each.FindAnnotation<FedMark>() != nullptr) cut_off.push_back(&each);
      if (!is_by_hand) LookUpstream(each, ages, driven);
    });
    if (!is_fed) driven.cut_off.insert(driven.cut_off.end(), cut_off.begin(), cut_off.end());
  }
}

void Standstill::LookAtParameters(const Port& source, Driven& driven) {
  VisitFeeds(source, [&](Port& feed) {
    const auto feeding = feed.Sources();
    driven.upstream.insert(driven.upstream.end(), feeding.begin(), feeding.end());
    if (feeding.empty()) driven.cut_off.push_back(&feed);
  });
}

std::string Standstill::WhyAtRest(const Driven& driven, const Scheduler& scheduler) {
  if (!driven.port->is_driving()) return "";
  if (std::string why = internal::WhyAtRest(driven.upstream, scheduler, Duration::max()); !why.empty()) return why;
  for (const Port* each : driven.cut_off) {
    // What somebody has set since is his.
    const auto* const parameter = dynamic_cast<const Configurable*>(each->parent()->parent());
    if (parameter == nullptr) return "nothing is connected to " + each->path() + " any more";
    if (parameter->is_fed()) return "nothing sets " + each->parent()->parent()->path() + " any more";
  }
  return "";
}

// Who does not run reads no safe value either.
void Standstill::LookAtReaders(const Driven& driven, const Scheduler& scheduler, const Tell& tell) {
  Port& port = *driven.port;
  if (port.is_driving()) {
    for (const Port* each : driven.sinks) scheduler.WakeWithoutData(*each);
  }
  const std::string why =
      port.is_driving() ? internal::WhyAtRest(driven.sinks, scheduler, Scheduler::kUnreachedAfter) : "";
  if (why.empty() && MarkOf(port) == nullptr) return;
  if (std::exchange(Mark(port).is_unreached, !why.empty()) == !why.empty()) return;
  tell(port,
       why.empty() ? "can be reached again"
                   : "cannot be reached: " + why + "; until it runs, no STOP counts there but the time-out of what it moves",
       why.empty());
}

void Standstill::LookAtSources(const Driven& driven, const Scheduler& scheduler, Time now, const Tell& tell) {
  Port& port = *driven.port;
  const auto held = MarkOf(port) != nullptr ? MarkOf(port)->rested : std::nullopt;
  const std::string why = WhyAtRest(driven, scheduler);
  const bool is_set = port.is_set_by_hand(Port::Setter::kRule);
  if (!why.empty()) {
    if (is_set) {  // a rule may have been first
      if (held) Mark(port).rested = now;
      return;
    }
    const auto safe = SafeValueOf(port);
    const auto set = safe ? PublishByHand(port, safe->get(), Port::Setter::kRule) : safe.error();
    if (!set && held) return;  // it has been told
    Mark(port).rested = now;
    return tell(port,
                set ? "has its safe value: " + why
                    : why + ", and it has no safe value: " + set.error().message,
                false);
  }
  if (!held) return;
  const bool is_fed = std::ranges::any_of(
      driven.sources, [&](const Port* each) { return HasPublishedSince(*each, *held); });
  if (!is_fed && !driven.sources.empty()) return;
  Mark(port).rested.reset();
  if (port.Release(Port::Setter::kRule)) tell(port, "is driven again: what feeds it runs", true);
}

void Standstill::LeaveToRule(Port& port) {
  if (MarkOf(port) != nullptr) Mark(port).rested.reset();
}

bool Standstill::TakesOver(Port& port, const Scheduler& scheduler, Time now) {
  Driven driven(port);
  if (WhyAtRest(driven, scheduler).empty()) return false;
  const auto safe = SafeValueOf(port);
  if (!safe || !PublishByHand(port, safe->get(), Port::Setter::kRule)) return false;
  Mark(port).rested = now;
  return true;
}

}  // namespace runnel::internal
