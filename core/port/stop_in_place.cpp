// What stops a port in the place of another one.

#include <algorithm>
#include <utility>

#include "core/element/runtime.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

constexpr const char* kDeclare = "have the new module declare that it drives, with its safe value";

// Where the safe value of `from` would be that of something else: the command of another unit, a zero that has become a position.
const Port* FindOtherMeaning(const Port& port, const Port& from, const AnyValue& safe_value, DrivingKind command) {
  const auto others = internal::EndsOf(from);
  const auto is_other = [&](const Port* end) {
    const bool is_same = !others.empty() && std::ranges::all_of(others, [&](const Port* each) { return each->unit() == end->unit(); });
    const bool is_position = DrivingKindByUnits(end->type(), end->unit()) == DrivingKind::kPosition;
    return !end->unit().empty() && !is_same && (is_position || !IsSafeInAnyUnit(safe_value, command));
  };
  const auto ends = internal::EndsOf(port);
  const auto found = std::ranges::find_if(ends, is_other);
  return found != ends.end() ? *found : nullptr;
}

bool IsStoppedBefore(const Port& port) {
  const auto of_robot = [](const internal::PassedStop& each) { return each.stop->robot() != nullptr; };
  return std::ranges::any_of(internal::PassedStops(port), of_robot);
}

bool IsSame(const PortStop& a, const PortStop& b) {
  const TypeInfo& type = a.safe_value().type();
  return ToText(type, a.safe_value().get()) == ToText(type, b.safe_value().get()) && a.command() == b.command() && a.brake() == b.brake();
}

// What a person who drove the composite has released counts no more.
void KeepBars(const Port& from, const PortStop& stop) {
  if (!from.is_proxy()) return;
  for (const Port* each : internal::EndsOf(from)) {
    const std::int64_t bar = each->stop() ? each->stop()->block()->bar() : StopSignal::kNever;
    if (bar != StopSignal::kNever && bar != StopSignal::kInForce) stop.block()->Bar([&] { return Time(Duration(bar)); });
  }
}

}  // namespace

// Those whose values are as they come through an interface port.
std::vector<const Port*> internal::EndsOf(const Port& port) {
  if (!port.is_proxy()) return {&port};
  std::vector<const Port*> ends;
  for (const Port* each : port.direction() == Port::Direction::kInput ? port.Sinks() : port.Sources()) {
    if (&each->type() == &port.type() && each->IsAtOrBelow(*port.parent())) ends.push_back(each);
  }
  return ends;
}

std::shared_ptr<const PortStop> internal::StopWithin(const Port& port) {
  const auto ends = port.is_proxy() ? EndsOf(port) : std::vector<const Port*>();
  std::shared_ptr<const PortStop> first;
  for (const Port* each : ends) {
    if (!each->is_driving()) continue;
    if (first && (!IsSame(*first, *each->stop()))) return nullptr;
    first = each->stop();
  }
  return first;
}

// What stops this port in the place of the other: what has been said of the place, then what its own module declares, then what
// it had if it was there before, else what stopped the other. With the block of the place.
Result<std::shared_ptr<const PortStop>> Port::StopInPlaceOf(const Port& from) const {
  const std::shared_ptr<const PortStop> before = from.stop();
  const auto mark = internal::DrivingState::MarkOf(from);
  const auto* const state = FindAnnotation<internal::DrivingState>();
  const bool comes_back = state != nullptr && state->is_replaced && state->mark == mark;
  // Its plugin may have been loaded anew meanwhile: what its module declares now counts.
  const bool is_declared = declared_stop() != nullptr;
  // An interface port says nothing where all that it leads to says it.
  const auto ends = is_proxy() ? internal::EndsOf(*this) : std::vector<const Port*>();
  const bool has_own = !ends.empty() && std::ranges::all_of(ends, [](const Port* each) { return each->declared_stop() != nullptr; });
  const PortStop* const within = has_own ? ends.front()->declared_stop() : nullptr;
  const auto with_block = [&](const AnyValue& safe, Duration brake, DrivingKind command, std::shared_ptr<StopSignal> robot) {
    auto stop = std::make_shared<const PortStop>(safe, brake, command, std::move(robot), before.get());
    if (!before) KeepBars(from, *stop);
    return stop;
  };
  const auto refuse = [&](const Port& end, const AnyValue& safe, std::string hint) {
    return Error{.message = "is in " + end.unit() + ", and its safe value, " + ToText(type(), safe.get()) + ", is not", .hint = std::move(hint)};
  };
  // Where nothing else is known of its place: of its own unit.
  const auto stopped = [&](const PortStop& by, const std::shared_ptr<StopSignal>& robot) -> Result<std::shared_ptr<const PortStop>> {
    const auto safe = FindSafeValue({}, DrivingKind::kUnspecified);
    const Port* const other = safe ? nullptr : FindOtherMeaning(*this, from, by.safe_value(), by.command());
    const bool may_be_refused = !comes_back || state->may_be_refused;
    if (other != nullptr && (!by.in_force() || (robot && !may_be_refused))) return std::shared_ptr<const PortStop>();
    if (other != nullptr && may_be_refused) {
      return refuse(*other, by.safe_value(), by.block()->in_force() ? "release its block first" : "release STOP first");
    }
    return with_block(safe ? *safe : by.safe_value(), {}, robot ? by.command() : DrivingKind::kUnspecified, robot);
  };
  // A port of a plain group, which gets its connections yet, is stopped by what is behind it as ever.
  const auto behind = is_proxy() && ends.empty() ? nullptr : internal::StopWithin(from);
  const std::shared_ptr<const PortStop> drove = before && before->robot() ? before : behind;
  if (!is_declared && within == nullptr && comes_back) {
    const PortStop* const had = state->stop_before.get();
    if (had != nullptr) return with_block(had->safe_value(), had->brake(), had->command(), had->robot());
    // What nobody has said to drive is not let go of while it is stopped.
    if (state->is_later && drove && drove->robot()->in_force() && !IsStoppedBefore(*this)) return stopped(*drove, drove->robot());
    if (before && before->block()->in_force()) return stopped(*before, nullptr);
    return std::shared_ptr<const PortStop>();
  }
  for (const internal::PassedStop& each : internal::PassedStops(from)) {
    if (each.stop == before || !each.stop->robot() || comes_back) continue;
    const Port* const other = FindOtherMeaning(*this, from, each.safe_value, each.stop->command());
    if (other != nullptr) return refuse(*other, each.safe_value, kDeclare);
  }
  if (within != nullptr && !mark) {
    if (!before || before->block()->bar() == StopSignal::kNever) return std::shared_ptr<const PortStop>();
    return with_block(within->safe_value(), {}, DrivingKind::kUnspecified, nullptr);
  }
  if (!is_declared && !drove) {
    const Port* const other = before ? FindOtherMeaning(*this, from, before->safe_value(), before->command()) : nullptr;
    return other == nullptr ? before : stopped(*before, nullptr);
  }
  const DrivingMark said = mark ? *mark : DrivingMark{};
  auto whole = Complete(said, within != nullptr ? within : drove.get());
  if (!whole) return whole.error();
  const bool is_its_own = (is_declared || within != nullptr) && !said.safe_value;
  if (const Port* const other = is_its_own || comes_back ? nullptr : FindOtherMeaning(*this, from, whole->safe_value, whole->command)) {
    return refuse(*other, whole->safe_value, said.safe_value ? "the application says the safe value of the place: correct its <driving>" : kDeclare);
  }
  const bool is_as_before = before && before->robot() && whole->safe_value.get() == before->safe_value().get() &&
                            whole->brake == before->brake() && whole->command == before->command();
  if (is_as_before) return before;
  return with_block(whole->safe_value, *whole->brake, whole->command, runtime().robot_stop().signal());
}

}  // namespace runnel
