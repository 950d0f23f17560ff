// One port in the place of another (Port::TakeOver()).

#include <algorithm>
#include <iterator>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/base/retry.h"
#include "core/element/runtime.h"
#include "core/port/converted_flow.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/value_copy.h"

namespace runnel {

namespace {

constexpr const char* kDeclare = "have the new module declare that it drives, with its safe value";

Error CannotTakeOver(const Port& port, std::string message) {
  return {.message = std::move(message), .path = port.path()};
}

// Made by the composite, which makes it again: not what leads round it.
bool IsWithin(const FrameworkElement& composite, const Port& from, const Port& to) {
  const bool leads_round_it = from.parent() == &composite && to.parent() == &composite && from.direction() == Port::Direction::kOutput;
  return from.IsAtOrBelow(composite) && to.IsAtOrBelow(composite) && !leads_round_it;
}

// A port and one in its place whose units differ.
std::pair<const Port*, const Port*> FindOtherUnit(const Port& port, const Port& from) {
  for (const Port* end : internal::EndsOf(port)) {
    for (const Port* other : internal::EndsOf(from)) {
      if (!end->unit().empty() && !other->unit().empty() && end->unit() != other->unit()) return {end, other};
    }
  }
  return {};
}

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

// What stops all that an interface port leads to.
std::shared_ptr<const PortStop> StopWithin(const Port& port) {
  const auto drives = [](const Port* each) { return each->is_driving(); };
  const auto ends = port.is_proxy() ? internal::EndsOf(port) : std::vector<const Port*>();
  return !ends.empty() && std::ranges::all_of(ends, drives) ? ends.front()->stop() : nullptr;
}

bool IsStoppedBefore(const Port& port) {
  const auto of_robot = [](const internal::PassedStop& each) { return each.stop->robot() != nullptr; };
  return std::ranges::any_of(internal::PassedStops(port), of_robot);
}

}  // namespace

// Those whose values are as they come through an interface port.
std::vector<const Port*> internal::EndsOf(const Port& port) {
  if (!port.is_proxy()) return {&port};
  std::vector<const Port*> ends;
  for (const Port* each : port.direction() == Port::Direction::kInput ? port.Sinks() : port.Sources()) {
    if (&each->type() == &port.type()) ends.push_back(each);
  }
  return ends;
}

Result<void> Port::CheckTakeOver(const Port& port, const Port& from, const ExchangedModules* modules) {
  const auto kind = [&](const Port& each) {
    return std::string(each.is_proxy() && modules == nullptr ? "an interface port" : "") +
           (each.direction() == Direction::kInput ? "an input" : "an output");
  };
  if (kind(port) != kind(from)) {
    return CannotTakeOver(port, "cannot take over from " + from.path() + ": one is " + kind(port) +
                                    ", the other is " + kind(from));
  }
  if (&port.type() != &from.type()) {
    return CannotTakeOver(port, "carries " + port.type().name() + " and cannot take over from " +
                                    from.path() + ", which carries " + from.type().name());
  }
  // What is connected was converted for the unit of the other one.
  if (const auto [end, other] = FindOtherUnit(port, from); end != nullptr) {
    return CannotTakeOver(port, "is in " + end->unit() + " and cannot take over from " + from.path() + ", which is in " +
                                    other->unit());
  }
  if (const auto stop = port.StopInPlaceOf(from); !stop) {
    Error error = CannotTakeOver(port, stop.error().message + "; it cannot take over from " + from.path());
    error.hint = stop.error().hint;
    return error;
  }
  if (modules == nullptr && (!port.incoming_.empty() || !port.outgoing_.empty())) {
    return CannotTakeOver(port, "is connected and cannot take over from " + from.path());
  }
  const auto pulls = [](const Connection& each) { return each.options.pull; };
  if (!port.is_pullable() && std::ranges::any_of(from.outgoing_, pulls))
    return CannotTakeOver(port, "cannot be pulled, and is to take over from one that is");
  return {};
}

void Port::TakeOver(Port& from, const ExchangedModules* modules) {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto possible = CheckTakeOver(*this, from, modules);
  RUNNEL_CHECK(possible, "a port cannot take over from another one");
  const std::vector<Port*> sinks = from.BoundSinks();
  const std::shared_ptr<const PortStop> before = from.stop();
  const AnyValue rest_before = from.FindRest();
  std::shared_ptr<const PortStop> after = *StopInPlaceOf(from);
  if (after) from.Extras();  // which this port has then
  if (modules != nullptr && (extras_ || from.extras_)) {
    Extras();
    from.Extras();
  }
  auto& own = internal::DrivingState::Of(*this);
  auto& its = internal::DrivingState::Of(from);
  ReserveFor(from);
  from.ReserveFor(*this);
  ExchangeConnections(from, sinks, modules != nullptr ? &modules->before : nullptr);
  try {
    if (modules == nullptr) TakeOverFlow(from);
    if (after != before) extras_->stop = after;
    if (modules != nullptr) {
      BindAnew(from);
    } else if (after != before) {
      RebindSinks();
    }
    // What moves by what its module passes on may be something else now.
    const auto has_moved = [](const Port* each) { return each->motion_beginnings() != 0; };
    const bool is_output = !is_proxy() && direction_ == Direction::kOutput, is_input = !is_proxy() && direction_ == Direction::kInput;
    if (is_output && has_moved(this)) VisitSiblings(*this, Direction::kInput, [](Port& each) { each.RebindSinks(); });
    bool moves = false;
    if (is_input) VisitSiblings(*this, Direction::kOutput, [&](const Port& each) { moves = moves || has_moved(&each); });
    if (moves) RebindSinks();
    const AnyValue rest = FindRest();
    if (rest && rest_before && (after != before || modules != nullptr)) MoveToRest(rest_before, rest);
  } catch (...) {
    // Each as it was, and what has been exchanged by then is exchanged again.
    if (extras_) extras_->stop = before;
    from.ExchangeConnections(*this, sinks, modules != nullptr ? &modules->after : nullptr);
    if (modules != nullptr) {
      Retry([&] { from.BindAnew(*this); });
    } else {
      from.TakeOverFlow(*this);
    }
    throw;
  }
  own.mark = its.mark;
  own.is_replaced = false;
  own.stop_before.reset();
  its.is_replaced = true;
  its.is_later = false;
  its.stop_before = before;
}

// Where it is for somebody who drives it no more, as SafeValueOf() says it.
AnyValue Port::FindRest() const {
  const auto stop = this->stop() ? this->stop() : StopWithin(*this);
  if (stop) return stop->safe_value();
  if (auto safe = FindSafeValue({}, DrivingKind::kUnspecified)) return *safe;
  const std::shared_ptr<const void> value = type_.is_transparent() ? type_.Make() : nullptr;
  return value ? AnyValue(type_, value) : AnyValue();
}

// What stands at rest there, or at ports before it, by a rule or for somebody who drives it no more, does so at the safe value of
// now.
void Port::MoveToRest(const AnyValue& before, const AnyValue& now) {
  const auto is_it = [&](const AnyValue& value) { return value && ToText(type(), value.get()) == ToText(type(), before.get()); };
  const std::shared_ptr<HandSlot> slot = HandSlot::Find(*this);
  const auto publisher = slot ? std::unique_lock(slot->mutex) : std::unique_lock<std::mutex>();
  const bool is_driven = slot && slot->hold && slot->hold->safe_value;
  for (const Setter setter : {Setter::kPerson, Setter::kRule}) {
    // What somebody has set for good is no rest, whatever it is.
    if (!is_set_by_hand(setter) || !type().is_transparent() || (setter == Setter::kPerson && !is_driven)) continue;
    Port& each = *extras_->by_hand[static_cast<std::size_t>(setter)];
    bool is_at_rest = false;
    each.VisitLatest([&](const void* value, ValueTimes) { is_at_rest = ToText(type(), value) == ToText(type(), before.get()); });
    if (!is_at_rest) continue;
    if (auto set = each.PublishFilled(internal::FillWith(now)); !set) throw ElementError(set.error());
  }
  if (is_driven && is_it(slot->hold->safe_value)) slot->hold->safe_value = now;
  for (Port* from : incoming_) {
    if (!from->is_driving() && !from->ConnectionTo(*this)->converted) from->MoveToRest(before, now);
  }
}

void Port::ReserveFor(const Port& from) {
  outgoing_.reserve(outgoing_.size() + from.outgoing_.size());
  incoming_.reserve(incoming_.size() + from.incoming_.size());
}

void Port::ExchangeConnections(Port& from, const std::vector<Port*>& sinks, const FrameworkElement* module) noexcept {
  const bool is_composite = module != nullptr && module->kind() == ElementKind::kGroup;
  const auto stays = [&](const Port& source, const Port& to) { return is_composite && IsWithin(*module, source, to); };
  const auto stays_at_source = [&](const Connection& each) { return stays(from, *each.to); };
  const auto stays_at_end = [&](const Port* each) { return stays(*each, from); };
  const auto first = std::stable_partition(from.outgoing_.begin(), from.outgoing_.end(), stays_at_source);
  for (auto each = first; each != from.outgoing_.end(); ++each) {
    each->from = this;
    std::ranges::replace(each->to->incoming_, &from, this);
  }
  const auto first_source = std::stable_partition(from.incoming_.begin(), from.incoming_.end(), stays_at_end);
  for (auto port = first_source; port != from.incoming_.end(); ++port) {
    for (Connection& each : (*port)->outgoing_) {
      if (each.to != &from) continue;
      each.to = this;
      if (each.converted) each.converted->set_target(*this);
    }
  }
  extras_.swap(from.extras_);
  if (module == nullptr) {
    motion_begins_at_ = from.motion_begins_at_.exchange(motion_begins_at_);
    motion_beginnings_ = from.motion_beginnings_.exchange(motion_beginnings_);
  } else if (extras_) {
    extras_->limits.swap(from.extras_->limits);
  }
  for (const Port* port : {static_cast<const Port*>(this), static_cast<const Port*>(&from)}) {
    if (port->extras_) port->extras_->StandFor(*port);
  }
  outgoing_.insert(outgoing_.end(), std::move_iterator(first), std::move_iterator(from.outgoing_.end()));
  from.outgoing_.erase(first, from.outgoing_.end());
  NoteOutgoing();
  from.NoteOutgoing();
  incoming_.insert(incoming_.end(), first_source, from.incoming_.end());
  from.incoming_.erase(first_source, from.incoming_.end());
  if (module != nullptr) return;
  for (Port* sink : sinks) {
    if (sink != &from && sink != this) sink->ReplaceSource(from, *this);
  }
}

void Port::BindAnew(Port& from) {
  for (Port* port : {this, &from}) {
    port->RebindSinks();
    port->PruneConversions();
  }
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
    return std::make_shared<const PortStop>(safe, brake, command, std::move(robot), before.get());
  };
  const auto refuse = [&](const Port& end, const AnyValue& safe, std::string hint) {
    return Error{.message = "is in " + end.unit() + ", and its safe value, " + ToText(type(), safe.get()) + ", is not", .hint = std::move(hint)};
  };
  // Where nothing else is known of its place: of its own unit.
  const auto stopped = [&](const PortStop& by, const std::shared_ptr<StopSignal>& robot) -> Result<std::shared_ptr<const PortStop>> {
    const auto safe = FindSafeValue({}, DrivingKind::kUnspecified);
    const Port* const other = safe ? nullptr : FindOtherMeaning(*this, from, by.safe_value(), by.command());
    if (other != nullptr && !by.in_force()) return std::shared_ptr<const PortStop>();
    if (other != nullptr && (!comes_back || state->is_later)) {
      return refuse(*other, by.safe_value(), by.block()->in_force() ? "release its block first" : "release STOP first");
    }
    return with_block(safe ? *safe : by.safe_value(), {}, robot ? by.command() : DrivingKind::kUnspecified, robot);
  };
  const std::shared_ptr<const PortStop> drove = before && before->robot() ? before : StopWithin(from);
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
