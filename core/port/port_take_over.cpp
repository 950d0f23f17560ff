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

namespace runnel {

namespace {

Error CannotTakeOver(const Port& port, std::string message, std::string hint = {}) {
  return {.message = std::move(message), .path = port.path(), .hint = std::move(hint)};
}

std::string TextOf(const AnyValue& value) { return ToText(value.type(), value.get()); }

bool Moves(const Port& port) {
  return port.stop() || std::ranges::any_of(internal::EndsOf(port), [](const Port* each) { return each->is_driving(); });
}

bool RestsAt(const Port& port, const AnyValue& rest) {
  const auto held = port.ValueByHand(Port::Setter::kRule), driven = port.ValueByHand();
  return (held && TextOf(held->value) == TextOf(rest)) || (driven && driven->is_at_rest && TextOf(driven->value) == TextOf(rest));
}

// A port that is at rest at `before`, and moves something for which `now` is no rest; none of `now`: nothing is rest for all.
const Port* FindRestOfOthers(const Port& port, const std::vector<Port*>& sinks, const AnyValue& before, const AnyValue& now) {
  if (!now && RestsAt(port, before)) return &port;
  for (const Port* from : port.incoming()) {
    if (from->is_driving() || from->ConnectionTo(port)->converted) continue;
    const auto is_other = [&](const Port* sink) {
      const auto is_held = [&](const internal::PassedStop& each) { return each.stop->robot() && now && TextOf(each.safe_value) != TextOf(now); };
      return std::ranges::find(sinks, sink) == sinks.end() && std::ranges::any_of(internal::PassedStops(*sink), is_held);
    };
    if (RestsAt(*from, before) && std::ranges::any_of(from->Sinks(), is_other)) return from;
    if (const Port* const farther = FindRestOfOthers(*from, sinks, before, now)) return farther;
  }
  return nullptr;
}

// As a file would connect it.
Result<void> CheckConversions(const Port& port, const Port& from, const FrameworkElement& module) {
  const auto check = [&](const Connection& edge, const Port& source, const Port& to) -> Result<void> {
    if (IsWithinComposite(module, *edge.from, *edge.to)) return {};
    const auto conversion = internal::ConversionBetween(source, to, edge.options.part, edge.options.convert);
    if (conversion && bool(*conversion) == bool(edge.converted)) return {};
    return CannotTakeOver(port, "cannot take over from " + from.path() + ": the values between " + edge.from->path() + " and " + edge.to->path() +
                                    (edge.converted ? " are converted by their units, which an interface port has not" : " would be converted"));
  };
  for (const Connection& each : from.outgoing()) {
    if (auto good = check(each, port, *each.to); !good) return good;
  }
  for (const Port* source : from.incoming()) {
    if (auto good = check(*source->ConnectionTo(from), *source, port); !good) return good;
  }
  return {};
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

}  // namespace

bool IsWithinComposite(const FrameworkElement& module, const Port& from, const Port& to) {
  const bool leads_round_it = from.parent() == &module && to.parent() == &module && from.direction() == Port::Direction::kOutput;
  return module.kind() == ElementKind::kGroup && from.IsAtOrBelow(module) && to.IsAtOrBelow(module) && !leads_round_it;
}

Result<void> Port::CheckTakeOver(const Port& port, const Port& from, const ExchangedModules* modules) {
  const auto kind = [&](const Port& each) {
    return std::string(each.is_proxy() && modules == nullptr ? "an interface port" : "") +
           (each.direction() == Direction::kInput ? "an input" : "an output");
  };
  if (kind(port) != kind(from)) {
    return CannotTakeOver(port, "cannot take over from " + from.path() + ": one is " + kind(port) + ", the other is " + kind(from));
  }
  if (&port.type() != &from.type()) {
    return CannotTakeOver(port, "carries " + port.type().name() + " and cannot take over from " + from.path() + ", which carries " +
                                    from.type().name());
  }
  // What is connected was converted for the unit of the other one.
  if (const auto [end, other] = FindOtherUnit(port, from); end != nullptr) {
    return CannotTakeOver(port, "is in " + end->unit() + " and cannot take over from " + from.path() + ", which is in " + other->unit());
  }
  if (const auto stop = port.StopInPlaceOf(from); !stop) {
    return CannotTakeOver(port, stop.error().message + "; it cannot take over from " + from.path(), stop.error().hint);
  } else if (const auto* state = port.FindAnnotation<internal::DrivingState>(); state == nullptr || !state->is_replaced || state->may_be_refused) {
    const AnyValue before = from.FindRest(), now = *stop ? (*stop)->safe_value() : port.FindRest();
    const bool leads_nowhere = port.is_proxy() && internal::EndsOf(port).empty(), moves = Moves(port) || Moves(from);
    const bool changes = moves && !leads_nowhere && before && (!now || TextOf(before) != TextOf(now));
    if (const Port* const rests = changes ? FindRestOfOthers(from, from.Sinks(), before, now) : nullptr) {
      const std::string what = now ? "has the safe value " + TextOf(now) : "moves several things, whose safe values differ";
      return CannotTakeOver(port, what + ", and " + rests->path() + " is at rest at " + TextOf(before) + (now ? ", by which others move, too" : ""),
                            "release it first");
    }
  }
  const auto converted = modules != nullptr ? CheckConversions(port, from, modules->before) : Result<void>();
  if (!converted) return converted;
  if (modules == nullptr && (!port.incoming_.empty() || !port.outgoing_.empty())) {
    return CannotTakeOver(port, "is connected and cannot take over from " + from.path());
  }
  const auto stays = [&](const Connection& each) { return modules != nullptr && IsWithinComposite(modules->before, from, *each.to); };
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
  const AnyValue rest_before = Moves(*this) || Moves(from) ? from.FindRest() : AnyValue();
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
    const AnyValue rest = rest_before ? FindRest() : AnyValue();
    if (rest && (after != before || modules != nullptr)) MoveToRest(rest_before, rest);
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
  its.is_later = its.may_be_refused = false;
  its.stop_before = before;
}

// Where it is for somebody who drives it no more, as SafeValueOf() says it.
AnyValue Port::FindRest() const {
  const auto stop = this->stop() ? this->stop() : internal::StopWithin(*this);
  if (stop) return stop->safe_value();
  if (Moves(*this)) return {};  // several, whose safe values differ
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
  const auto stays = [&](const Port& source, const Port& to) { return module != nullptr && IsWithinComposite(*module, source, to); };
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
