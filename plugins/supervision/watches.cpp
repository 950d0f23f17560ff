#include "plugins/supervision/watches.h"

#include <algorithm>

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

// Of an input, or a parameter, on the way to what drives: whether something is connected to it.
struct FedMark final : Annotation {
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    auto mark = std::make_unique<FedMark>(*this);
    mark->has_moved = true;
    return mark;
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  bool is_fed = true;
  bool has_moved = false;
  Time cut{};        // when it was found that nothing is any more
  std::string text;  // the parameter's value then
};

// Of an output: when its module was last seen not to run, if it has published nothing since.
struct SilentMark final : Annotation {
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<SilentMark>(*this);
  }
  std::optional<Time> since;
};

const RestMark* MarkOf(const Port& port) { return port.FindAnnotation<RestMark>(); }

bool HasPublishedSince(const Port& source, Time since) {
  bool has_published = false;
  source.VisitLatest([&](const void*, ValueTimes times) { has_published = times.publication_time > since; });
  return has_published;
}

// By which something moves: the port itself, or whoever beside the tree sends it to another application; nullptr: none.
const Port* FindWhatMoves(const Port& port) {
  if (port.is_driving()) return &port;
  for (const Port* sink : port.Sinks()) {
    if (!sink->is_driving()) continue;
    const auto listed = port.runtime().root().Find(sink->path());
    if (!listed || *listed != sink) return sink;
  }
  return nullptr;
}

// What moves here by what is sent is held itself: only the value of those elsewhere counts.
Result<AnyValue> SafeValueToHold(const Port& port) {
  const Port* const moves = FindWhatMoves(port);
  return SafeValueOf(moves != nullptr ? *moves : port);
}

// What it said before it was at rest counts no more.
std::string WhySilent(Port& output, const Scheduler& scheduler, Time now) {
  const std::string why = scheduler.WhyAtRest(output);
  auto* const mark = output.FindAnnotation<SilentMark>();
  if (!why.empty()) {
    output.FindOrAnnotate<SilentMark>().since = now;
    return why;
  }
  if (mark == nullptr || !mark->since) return "";
  if (!HasPublishedSince(output, *mark->since)) return output.path() + " has published nothing since it was at rest";
  mark->since.reset();
  return "";
}

// A person who sets the parameter has decided; what a replacement has is no word of a person's.
bool IsStillCut(const FrameworkElement& parameter) {
  const auto* const configurable = dynamic_cast<const Configurable*>(&parameter);
  const auto* const mark = parameter.FindAnnotation<FedMark>();
  if (configurable == nullptr || mark == nullptr) return false;
  return configurable->is_fed() || (mark->has_moved && configurable->ToText() == mark->text);
}

}  // namespace

StaleWatch::Turn StaleWatch::Look(Runtime& runtime, Time now) {
  if (!heard_) heard_ = now;  // what has never come is missing from now on
  Hear(runtime);
  const bool is_silent = now - *heard_ > rule_->after;
  // A part of it may have been done, so it is done again; silence first, whatever has come meanwhile.
  if (pending_ == Turn::kNone) {
    pending_ = Judge(is_silent);
  } else if (is_silent) {
    pending_ = Turn::kStale;
  }
  if (pending_ == Turn::kNone) NoteDone(pending_, now);
  return pending_;
}

void StaleWatch::NoteDone(Turn turn, Time now) noexcept {
  pending_ = Turn::kNone;
  if (turn != Turn::kNone) {
    is_stale_ = turn == Turn::kStale;
    well_since_.reset();
  }
  next_look_ = is_stale_ ? now + std::max(std::min(rule_->after, rule_->fresh_after) / 4, kShortestWait)
                         : SaturatingSum(SaturatingSum(*heard_, rule_->after), Duration(1));
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

StaleWatch::Turn StaleWatch::Judge(bool is_silent) {
  if (!is_stale_) return is_silent ? Turn::kStale : Turn::kNone;
  if (is_silent) {
    well_since_.reset();
    return Turn::kNone;
  }
  if (!well_since_) well_since_ = *heard_;
  return *heard_ - *well_since_ < rule_->fresh_after ? Turn::kNone : Turn::kFresh;
}

void Standstill::Look(Runtime& runtime, const Scheduler& scheduler, Time now, const Tell& tell) {
  if (revision_ != runtime.revision()) {
    revision_ = ~std::uint64_t{};  // until all are found
    driven_.clear();
    outputs_.clear();
    runtime.root().Visit([this, now](FrameworkElement& element) {
      auto* const port = dynamic_cast<Port*>(&element);
      if (port == nullptr) return;
      const bool drives = FindWhatMoves(*port) != nullptr;
      if (drives || MarkOf(*port) != nullptr) driven_.push_back({port, port->Sinks(), Feeding(*port, now), drives});
      if (port->direction() == Port::Direction::kOutput) outputs_.push_back(port);
    });
    revision_ = runtime.revision();
  }
  EachForItself ports;
  for (const Driven& each : driven_) {
    ports.Do([&] { LookAtReaders(each, scheduler, tell); });
    ports.Do([&] { LookAtSources(each, scheduler, now, tell); });
  }
  for (Port* const each : outputs_) {
    ports.Do([&] {
      (void)WhySilent(*each, scheduler, now);  // it is noted: a rule may have switched it away, and switch it back
      if (!each->stamps_ahead() || std::exchange(each->FindOrAnnotate<RestMark>().is_ahead_told, true)) return;
      tell(*each, "bears times of measurement that are still to come; they count as the time of publication", false);
    });
  }
  ports.End();
}

Feeding::Feeding(Port& port, Time now) : port_(port), at_(now), sources_(port.Sources()) {
  const auto* const input = dynamic_cast<const InputBase*>(&port);
  LookAtParameters(port);
  LookUpstream(port, input != nullptr && input->ageing() == Ageing::kTimesOut);
}

// As far as nobody asks how old it is: what a module does not ask it puts out as new, so that nobody behind it can tell.
// Beyond that by inputs of the same type only, for what sets parameters there, which do not grow old.
void Feeding::LookUpstream(const Port& input, bool times_out) {
  for (Port* source : input.Sources()) {
    if (!seen_.insert({source, times_out}).second) continue;
    if ((&input == &port_ || !times_out) && std::ranges::find(upstream_, source) == upstream_.end())
      upstream_.push_back(source);
    LookAtParameters(*source);
    VisitSiblings(*source, Port::Direction::kInput, [&](Port& each) {
      const auto* const base = dynamic_cast<const InputBase*>(&each);
      const Ageing ageing = base != nullptr ? base->ageing() : Ageing::kUnspecified;
      const bool ages =
          ageing == Ageing::kPassedOn ? times_out : ageing == Ageing::kTimesOut || ageing == Ageing::kSetOnce;
      if (each.is_set_by_hand(Port::Setter::kPerson)) return;  // whatever comes there does not count
      if (ages && &each.type() != &source->type()) return;
      LookUpstream(each, ages);
      if (!ages && LookAtCut(each, !each.Sources().empty())) cut_off_.push_back(&each);
    });
  }
}

void Feeding::LookAtParameters(const Port& of) {
  FrameworkElement* const module = FindModuleOf(of);
  if (module == nullptr) return;
  module->Visit([&](FrameworkElement& each) {
    if (each.kind() != ElementKind::kParameter) return;
    bool is_fed = false;
    each.Visit([&](FrameworkElement& below) {
      const auto* const feed = dynamic_cast<const Port*>(&below);
      if (feed == nullptr || feed->Sources().empty()) return;
      is_fed = true;
      LookUpstream(*feed, false);
    });
    if (LookAtCut(each, is_fed)) parameters_.push_back(&each);
  });
}

// Whether something was connected to it.
bool Feeding::LookAtCut(FrameworkElement& element, bool is_fed) const {
  auto* mark = element.FindAnnotation<FedMark>();
  if (is_fed) {
    element.FindOrAnnotate<FedMark>().is_fed = true;
    return false;
  }
  if (mark == nullptr) return false;
  if (std::exchange(mark->is_fed, false)) {
    mark->cut = at_;
    if (const auto* const configurable = dynamic_cast<const Configurable*>(&element))
      mark->text = configurable->ToText();
  }
  return true;
}

std::string Feeding::WhyAtRest(const Scheduler& scheduler, Time now) const {
  std::string why;
  for (Port* each : upstream_) {
    const std::string silent = WhySilent(*each, scheduler, now);  // of each, for it is noted
    if (why.empty()) why = silent;
  }
  for (const FrameworkElement* each : parameters_) {
    if (why.empty() && IsStillCut(*each)) why = "nothing sets " + each->path() + " any more";
  }
  for (const Port* each : cut_off_) {
    const auto* const mark = each->FindAnnotation<FedMark>();
    const bool is_over = mark == nullptr || std::ranges::any_of(sources_, [&](const Port* source) {
                           return HasPublishedSince(*source, mark->cut);
                         });
    if (why.empty() && !is_over) why = "nothing is connected to " + each->path() + " any more";
  }
  return why;
}

// Who does not run reads no safe value either.
void Standstill::LookAtReaders(const Driven& driven, const Scheduler& scheduler, const Tell& tell) {
  Port& port = *driven.port;
  for (const Port* each : driven.sinks) {
    if (port.is_driving()) scheduler.WakeWithoutData(*each);
  }
  const std::string why = scheduler.WhyUnreached(port, driven.sinks);
  if (why.empty() && MarkOf(port) == nullptr) return;
  if (std::exchange(port.FindOrAnnotate<RestMark>().is_unreached, !why.empty()) == !why.empty()) return;
  tell(port,
       why.empty()
           ? "can be reached again"
           : "cannot be reached: " + why + "; until it runs, no STOP counts there but the time-out of what it moves",
       why.empty());
}

void Standstill::LookAtSources(const Driven& driven, const Scheduler& scheduler, Time now, const Tell& tell) {
  Port& port = *driven.port;
  const auto held = MarkOf(port) != nullptr ? MarkOf(port)->rested : std::nullopt;
  const std::string why = driven.drives ? driven.feeding.WhyAtRest(scheduler, now) : "";
  const bool is_set = port.is_set_by_hand(Port::Setter::kRule);
  if (!why.empty()) {
    if (is_set) {  // a rule may have been first
      if (held) port.FindOrAnnotate<RestMark>().rested = now;
      return;
    }
    const auto safe = SafeValueToHold(port);
    const auto set = safe ? PublishByHand(port, safe->get(), Port::Setter::kRule) : safe.error();
    if (!set && held) return;  // it has been told
    port.FindOrAnnotate<RestMark>().rested = now;
    return tell(port, set ? "has its safe value: " + why : why + ", and it has no safe value: " + set.error().message,
                false);
  }
  if (!held) return;
  const bool is_fed =
      std::ranges::any_of(driven.feeding.sources(), [&](const Port* each) { return HasPublishedSince(*each, *held); });
  if (!is_fed && !driven.feeding.sources().empty()) return;
  port.FindOrAnnotate<RestMark>().rested.reset();
  if (port.Release(Port::Setter::kRule)) tell(port, "is driven again: what feeds it runs", true);
}

void Standstill::LeaveToRule(Port& port) {
  if (MarkOf(port) != nullptr) port.FindOrAnnotate<RestMark>().rested.reset();
}

bool Standstill::TakesOver(Port& port, const Scheduler& scheduler, Time now) {
  if (FindWhatMoves(port) == nullptr || Feeding(port, now).WhyAtRest(scheduler, now).empty()) return false;
  const auto safe = SafeValueToHold(port);
  if (!safe || !PublishByHand(port, safe->get(), Port::Setter::kRule)) return false;
  port.FindOrAnnotate<RestMark>().rested = now;
  return true;
}

}  // namespace runnel::internal
