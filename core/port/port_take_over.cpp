// One port in the place of another (Port::TakeOver()).

#include <algorithm>
#include <iterator>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/base/retry.h"
#include "core/element/runtime.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

Error CannotTakeOver(const Port& port, std::string message, std::string hint = {}) {
  return {.message = std::move(message), .path = port.path(), .hint = std::move(hint)};
}

std::string TextOf(const AnyValue& value) { return ToText(value.type(), value.get()); }

bool IsSame(const PortStop& a, const PortStop& b) {
  return TextOf(a.safe_value()) == TextOf(b.safe_value()) && a.command() == b.command() && a.brake() == b.brake();
}

bool IsSame(const InputLimits& a, const InputLimits& b) {
  const auto text = [](const AnyValue& value) { return value ? "=" + TextOf(value) : ""; };
  return a.minimum == b.minimum && a.maximum == b.maximum && a.out_of_bounds == b.out_of_bounds &&
         text(a.default_value) == text(b.default_value);
}

bool RestsAt(const Port& port, const AnyValue& rest) {
  const auto held = port.ValueByHand(Port::Setter::kRule), driven = port.ValueByHand();
  return (held && TextOf(held->value) == TextOf(rest)) ||
         (driven && driven->is_at_rest && TextOf(driven->value) == TextOf(rest));
}

// A port that is at rest at `before`, and moves something for which `now` is no rest.
const Port* FindRestOfOthers(const Port& port, const std::vector<Port*>& sinks, const AnyValue& before,
                             const AnyValue& now) {
  for (const Port* from : port.incoming()) {
    if (from->is_driving() || from->ConnectionTo(port)->converted) continue;
    const auto is_other = [&](const Port* sink) {
      const auto is_held = [&](const internal::PassedStop& each) {
        return each.stop->robot() && TextOf(each.safe_value) != TextOf(now);
      };
      return std::ranges::find(sinks, sink) == sinks.end() &&
             std::ranges::any_of(internal::PassedStops(*sink), is_held);
    };
    if (RestsAt(*from, before) && std::ranges::any_of(from->Sinks(), is_other)) return from;
    if (const Port* const farther = FindRestOfOthers(*from, sinks, before, now)) return farther;
  }
  return nullptr;
}

// Of which the values are: of an interface port, as they are on either side of it, but within its group, without a conversion to another type.
std::set<std::string> UnitsOf(const Port& port) {
  if (!port.is_proxy()) return {port.unit()};
  std::set<std::string> units;
  for (const Port* each : port.direction() == Port::Direction::kInput ? port.Sinks() : port.Sources()) {
    if (&each->type() == &port.type() && each->IsAtOrBelow(*port.parent())) units.insert(each->unit());
  }
  return units;
}

// What is connected was converted for the unit of the other one, and what stops an interface port, or its block, is of its own.
Result<void> CheckUnits(const Port& port, const Port& from, bool is_strict) {
  const auto units = UnitsOf(port), others = UnitsOf(from);
  if (units == others) return {};
  const bool has_to_be_same = is_strict && (port.is_proxy() || from.is_proxy()) && !internal::PassedStops(from).empty();
  for (const std::string& each : units) {
    for (const std::string& other : others) {
      if (each == other || (!has_to_be_same && (each.empty() || other.empty()))) continue;
      const auto in = [](const std::string& unit) { return "is in " + (unit.empty() ? "no unit" : unit); };
      return CannotTakeOver(
          port, in(each) + " and cannot take over from " + from.path() + ", which " + in(other),
          "disconnect it first; where something moves by it, delete the module, and create the other one");
    }
  }
  return {};
}

}  // namespace

bool IsWithinComposite(const FrameworkElement& module, const Port& from, const Port& to) {
  const bool leads_round_it =
      from.parent() == &module && to.parent() == &module && from.direction() == Port::Direction::kOutput;
  return module.kind() == ElementKind::kGroup && from.IsAtOrBelow(module) && to.IsAtOrBelow(module) && !leads_round_it;
}

Result<void> Port::CheckTakeOver(const Port& port, const Port& from, const ExchangedModules* modules) {
  const auto kind = [&](const Port& each) {
    return std::string(each.is_proxy() && modules == nullptr ? "an interface port" : "") +
           (each.direction() == Direction::kInput ? "an input" : "an output");
  };
  if (kind(port) != kind(from)) {
    return CannotTakeOver(
        port, "cannot take over from " + from.path() + ": one is " + kind(port) + ", the other is " + kind(from));
  }
  if (&port.type() != &from.type()) {
    return CannotTakeOver(port, "carries " + port.type().name() + " and cannot take over from " + from.path() +
                                    ", which carries " + from.type().name());
  }
  // On the way back less is refused; on that of a change that has failed nothing that has been there before.
  const auto* const state = port.FindAnnotation<internal::DrivingState>();
  const bool may_be_refused = state == nullptr || !state->is_replaced || state->may_be_refused;
  if (auto good = CheckUnits(port, from, may_be_refused || state->is_later); !good) return good;
  if (const auto stop = port.StopInPlaceOf(from); !stop) {
    return CannotTakeOver(port, stop.error().message + "; it cannot take over from " + from.path(), stop.error().hint);
  } else if (may_be_refused) {
    const auto *declared = port.declared_stop(), *other = from.declared_stop();
    const bool is_alike =
        port.is_proxy() == from.is_proxy() && port.unit() == from.unit() &&
        (declared == nullptr || other == nullptr ? declared == other : IsSame(*declared, *other)) &&
        (declared != nullptr || !port.is_driving() || (from.is_driving() && IsSame(*port.stop(), *from.stop())));
    if (modules != nullptr && (port.is_driving() || from.is_driving()) && !is_alike) {
      return CannotTakeOver(port, "moves nothing, or not in the same way as " + from.path(),
                            "delete the module, and create the other one");
    }
    const AnyValue before = from.FindRest(), now = *stop ? (*stop)->safe_value() : port.FindRest();
    const bool changes = (port.stop() || from.stop()) && before && now && TextOf(before) != TextOf(now);
    if (const Port* const rests = changes ? FindRestOfOthers(from, from.Sinks(), before, now) : nullptr) {
      const std::string what =
          "has the safe value " + TextOf(now) + ", and " + rests->path() + " is at rest at " + TextOf(before);
      return CannotTakeOver(port, what + ", by which others move, too", "release it first");
    }
  }
  if (modules == nullptr && (!port.incoming_.empty() || !port.outgoing_.empty())) {
    return CannotTakeOver(port, "is connected and cannot take over from " + from.path());
  }
  const auto stays = [&](const Connection& each) {
    return modules != nullptr && IsWithinComposite(modules->before, from, *each.to);
  };
  const auto pulls = [&](const Connection& each) { return each.options.pull && !stays(each); };
  if (port.is_pullable() || std::ranges::none_of(from.outgoing_, pulls)) return {};
  return CannotTakeOver(port, "cannot be pulled, and is to take over from one that is");
}

void Port::TakeOver(Port& from, const ExchangedModules* modules) {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto possible = CheckTakeOver(*this, from, modules);
  RUNNEL_CHECK(possible, "a port cannot take over from another one");
  const std::vector<Port*> sinks = from.BoundSinks();
  const std::shared_ptr<const PortStop> before = from.stop();
  const AnyValue rest_before = stop() || from.stop() ? from.FindRest() : AnyValue();
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
  // What holds values to the limits of the one goes over with its flow; each has limits of its own.
  const InputLimits own_limits = limits(), its_limits = from.limits();
  const auto limit = [&, are_same = IsSame(own_limits, its_limits)] {
    if (are_same) return;
    (void)SetLimits(own_limits);
    (void)from.SetLimits(its_limits);
  };
  ExchangeConnections(from, sinks, modules != nullptr ? &modules->before : nullptr);
  if (modules == nullptr) ExchangeFlow(from);
  try {
    if (modules == nullptr) FollowExchange(from), limit();
    if (after != before) extras_->stop = after;
    if (modules != nullptr) {
      BindAnew(from);
    } else if (after != before) {
      RebindSinks();
    }
    // What moves by what its module passes on may be something else now.
    const auto has_moved = [](const Port* each) { return each->motion_beginnings() != 0; };
    const bool is_output = !is_proxy() && direction_ == Direction::kOutput,
               is_input = !is_proxy() && direction_ == Direction::kInput;
    if (is_output && has_moved(this)) VisitSiblings(*this, Direction::kInput, [](Port& each) { each.RebindSinks(); });
    bool moves = false;
    if (is_input)
      VisitSiblings(*this, Direction::kOutput, [&](const Port& each) { moves = moves || has_moved(&each); });
    if (moves) RebindSinks();
    const AnyValue rest = rest_before ? FindRest() : AnyValue();
    if (rest && after != before) MoveToRest(rest_before, rest);
  } catch (...) {
    // Each as it was, and what has been exchanged by then is exchanged again.
    if (extras_) extras_->stop = before;
    from.ExchangeConnections(*this, sinks, modules != nullptr ? &modules->after : nullptr);
    if (modules == nullptr) from.ExchangeFlow(*this);
    Retry([&] {
      from.BindAnew(*this);
      if (modules == nullptr) limit();
    });
    throw;
  }
  own.mark = its.mark;
  own.is_replaced = false;
  own.stop_before.reset();
  its.is_replaced = true;
  its.is_later = its.may_be_refused = false;
  its.stop_before = before;
}

// Where it is for somebody who drives it no more, as SafeValueOf() says it.
AnyValue Port::FindRest() const {
  if (const auto stop = this->stop()) return stop->safe_value();
  if (auto safe = FindSafeValue({}, DrivingKind::kUnspecified)) return *safe;
  const std::shared_ptr<const void> value = type_.is_transparent() ? type_.Make() : nullptr;
  return value ? AnyValue(type_, value) : AnyValue();
}

// What stands at rest there, or at ports before it, by a rule or for somebody who drives no more, does so at what is safe now.
void Port::MoveToRest(const AnyValue& before, const AnyValue& now) {
  const std::shared_ptr<HandSlot> slot = HandSlot::Find(*this);
  const auto publisher = slot ? std::unique_lock(slot->mutex) : std::unique_lock<std::mutex>();
  const bool is_driven = slot && slot->hold && slot->hold->safe_value;
  for (const Setter setter : {Setter::kPerson, Setter::kRule}) {
    // What somebody has set for good is no rest, whatever it is.
    if (!is_set_by_hand(setter) || !type().is_transparent() || (setter == Setter::kPerson && !is_driven)) continue;
    Port& each = *extras_->by_hand[static_cast<std::size_t>(setter)];
    bool is_at_rest = false;
    each.VisitLatest([&](const void* value, ValueTimes) { is_at_rest = ToText(type(), value) == TextOf(before); });
    if (!is_at_rest) continue;
    if (auto set = each.PublishFilled(internal::FillWith(now)); !set) throw ElementError(set.error());
  }
  if (is_driven && TextOf(slot->hold->safe_value) == TextOf(before)) slot->hold->safe_value = now;
  for (Port* from : incoming_) {
    if (!from->is_driving() && !from->ConnectionTo(*this)->converted) from->MoveToRest(before, now);
  }
}

void Port::ReserveFor(const Port& from) {
  outgoing_.reserve(outgoing_.size() + from.outgoing_.size());
  incoming_.reserve(incoming_.size() + from.incoming_.size());
}

void Port::ExchangeConnections(Port& from, const std::vector<Port*>& sinks, const FrameworkElement* module) noexcept {
  const auto stays = [&](const Port& source, const Port& to) {
    return module != nullptr && IsWithinComposite(*module, source, to);
  };
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
  for (const Port* port : std::initializer_list<const Port*>{this, &from}) {
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

}  // namespace runnel
