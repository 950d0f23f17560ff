#include "plugins/supervision/standstill.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/element/runtime.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel::internal {

namespace {

// That the value in the port's slot of rules is of here, and when its source was last seen at rest.
struct HeldMark final : Annotation {
  explicit HeldMark(std::optional<Time> when) : rested(when) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<HeldMark>(rested);
  }
  const std::optional<Time> rested;  // nullopt: it is not
};

std::optional<Time> HeldAt(const Port& port) {
  const auto* const mark = port.FindAnnotation<HeldMark>();
  return mark != nullptr ? mark->rested : std::nullopt;
}

void Mark(Port& port, std::optional<Time> rested) {
  port.Annotate(std::make_unique<HeldMark>(rested));
}

bool HasPublishedSince(const Port& source, Time since) {
  bool has_published = false;
  source.VisitLatest(
      [&](const void*, ValueTimes times) { has_published = times.publication_time > since; });
  return has_published;
}

}  // namespace

void Standstill::Look(Runtime& runtime, const Scheduler& scheduler, Time now, const Tell& tell) {
  if (std::exchange(revision_, runtime.revision()) != runtime.revision()) {
    driven_.clear();
    runtime.root().Visit([this](FrameworkElement& element) {
      auto* const port = dynamic_cast<Port*>(&element);
      if (port != nullptr && (port->is_driving() || HeldAt(*port)))
        driven_.push_back({port, port->Sources()});
    });
  }
  for (const Driven& each : driven_) Look(each, scheduler, now, tell);
}

void Standstill::Look(const Driven& driven, const Scheduler& scheduler, Time now,
                      const Tell& tell) {
  Port& port = *driven.port;
  const auto held = HeldAt(port);
  std::string why;
  for (const Port* source : driven.sources) {
    if (why.empty() && port.is_driving()) why = scheduler.WhyAtRest(*source);
  }
  const bool is_set = port.is_set_by_hand(Port::Setter::kRule);
  if (!why.empty()) {
    if (is_set) return held ? Mark(port, now) : void();  // a rule may have been first
    const auto safe = SafeValueOf(port);
    const auto set = safe ? PublishByHand(port, safe->get(), Port::Setter::kRule) : safe.error();
    if (!set && held) return;  // it has been told
    Mark(port, now);
    return tell(port,
                set ? "has its safe value: " + why
                    : why + ", and it has no safe value: " + set.error().message,
                false);
  }
  if (!held) return;
  const bool is_fed = std::ranges::any_of(
      driven.sources, [&](const Port* each) { return HasPublishedSince(*each, *held); });
  if (!is_fed && !driven.sources.empty()) return;
  Mark(port, {});
  if (port.Release(Port::Setter::kRule)) tell(port, "is driven again: what feeds it runs", true);
}

void Standstill::LeaveToRule(Port& port) {
  if (HeldAt(port)) Mark(port, {});
}

}  // namespace runnel::internal
