// One port in the place of another (Port::TakeOver()).

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/check.h"
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

}  // namespace

Result<void> Port::CheckTakeOver(const Port& port, const Port& from) {
  const auto kind = [](const Port& each) {
    return std::string(each.is_proxy() ? "an interface port" : "") +
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
  if (!port.unit().empty() && !from.unit().empty() && port.unit() != from.unit()) {
    return CannotTakeOver(port, "is in " + port.unit() + " and cannot take over from " + from.path() + ", which is in " +
                                    from.unit());
  }
  if (const auto stop = port.StopInPlaceOf(from); !stop) {
    Error error = CannotTakeOver(port, stop.error().message + "; it cannot take over from " + from.path());
    error.hint = stop.error().hint;
    return error;
  }
  if (!port.incoming_.empty() || !port.outgoing_.empty()) {
    return CannotTakeOver(port, "is connected and cannot take over from " + from.path());
  }
  const auto pulls = [](const Connection& each) { return each.options.pull; };
  if (!port.is_pullable() && std::ranges::any_of(from.outgoing_, pulls))
    return CannotTakeOver(port, "cannot be pulled, and is to take over from one that is");
  return {};
}

void Port::TakeOver(Port& from) {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto possible = CheckTakeOver(*this, from);
  RUNNEL_CHECK(possible, "a port cannot take over from another one");
  const std::vector<Port*> sinks = from.BoundSinks();
  const std::shared_ptr<const PortStop> before = from.stop();
  std::shared_ptr<const PortStop> after = *StopInPlaceOf(from);
  if (after) from.Extras();  // which this port has then
  auto& own = internal::DrivingState::Of(*this);
  auto& its = internal::DrivingState::Of(from);
  ExchangeConnections(from, sinks);
  try {
    TakeOverFlow(from);
    if (after != before) {
      extras_->stop = after;
      RebindSinks();
    }
    // What moves by what its module passes on may be something else now.
    const auto has_moved = [](const Port* each) { return each->motion_beginnings() != 0; };
    const bool is_output = !is_proxy() && direction_ == Direction::kOutput, is_input = !is_proxy() && direction_ == Direction::kInput;
    if (is_output && has_moved(this)) VisitSiblings(*this, Direction::kInput, [](Port& each) { each.RebindSinks(); });
    bool moves = false;
    if (is_input) VisitSiblings(*this, Direction::kOutput, [&](const Port& each) { moves = moves || has_moved(&each); });
    if (moves) RebindSinks();
    if (after != before) {
      const auto rest = after ? Result<AnyValue>(after->safe_value()) : FindSafeValue({}, DrivingKind::kUnspecified);
      if (rest) MoveToRest(before.get(), *rest);
    }
  } catch (...) {
    // Each as it was, and what has been exchanged by then is exchanged again.
    if (extras_) extras_->stop = before;
    from.ExchangeConnections(*this, sinks);
    from.TakeOverFlow(*this);
    throw;
  }
  own.mark = its.mark;
  own.is_replaced = false;
  own.stop_before.reset();
  its.is_replaced = true;
  its.stop_before = before;
}

// What stands at rest there, by a rule or for somebody who drives it no more, does so at the safe value of now.
void Port::MoveToRest(const PortStop* before, const AnyValue& now) {
  const std::shared_ptr<HandSlot> slot = HandSlot::Find(*this);
  const auto publisher = slot ? std::unique_lock(slot->mutex) : std::unique_lock<std::mutex>();
  for (const auto& each : extras_->by_hand) {
    if (!each || before == nullptr || !type().is_transparent()) continue;
    bool is_at_rest = false;
    each->VisitLatest([&](const void* value, ValueTimes) { is_at_rest = ToText(type(), value) == ToText(type(), before->safe_value().get()); });
    if (!is_at_rest) continue;
    if (auto set = each->PublishFilled(internal::FillWith(now)); !set) throw ElementError(set.error());
  }
  if (slot && slot->hold && slot->hold->safe_value) slot->hold->safe_value = now;
}

void Port::ExchangeConnections(Port& from, const std::vector<Port*>& sinks) noexcept {
  for (Connection& each : from.outgoing_) {
    each.from = this;
    std::ranges::replace(each.to->incoming_, &from, this);
  }
  for (Port* port : from.incoming_) {
    for (Connection& each : port->outgoing_) {
      if (each.to != &from) continue;
      each.to = this;
      if (each.converted) each.converted->set_target(*this);
    }
  }
  extras_.swap(from.extras_);
  motion_begins_at_ = from.motion_begins_at_.exchange(motion_begins_at_);
  motion_beginnings_ = from.motion_beginnings_.exchange(motion_beginnings_);
  for (const Port* port : {static_cast<const Port*>(this), static_cast<const Port*>(&from)}) {
    if (port->extras_) port->extras_->StandFor(*port);
  }
  outgoing_.swap(from.outgoing_);
  NoteOutgoing();
  from.NoteOutgoing();
  incoming_.swap(from.incoming_);
  for (Port* sink : sinks) {
    if (sink != &from && sink != this) sink->ReplaceSource(from, *this);
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
  const auto with_block = [&](const AnyValue& safe, Duration brake, DrivingKind command, std::shared_ptr<StopSignal> robot) {
    return std::make_shared<const PortStop>(safe, brake, command, std::move(robot), before.get());
  };
  if (!is_declared && comes_back) {
    const PortStop* const had = state->stop_before.get();
    if (had != nullptr) return with_block(had->safe_value(), had->brake(), had->command(), had->robot());
    if (!before || !before->block()->in_force()) return std::shared_ptr<const PortStop>();
    const auto safe = FindSafeValue({}, DrivingKind::kUnspecified);
    return with_block(safe ? *safe : before->safe_value(), {}, DrivingKind::kUnspecified, nullptr);
  }
  const auto goes_over = [&](const AnyValue& safe, DrivingKind command) {
    return comes_back || unit().empty() || unit() == from.unit() || IsSafeInAnyUnit(safe, command);
  };
  const auto refuse = [&](const AnyValue& safe, std::string hint) {
    return Error{.message = "is in " + unit() + ", and its safe value, " + ToText(type(), safe.get()) + ", is not", .hint = std::move(hint)};
  };
  if (!is_declared && (!before || !before->robot())) {
    for (const internal::PassedStop& each : internal::PassedStops(from)) {
      if (each.stop->robot() && !goes_over(each.safe_value, each.stop->command())) return refuse(each.safe_value, kDeclare);
    }
    if (!before || goes_over(before->safe_value(), before->command())) return before;
    const auto safe = FindSafeValue({}, DrivingKind::kUnspecified);
    if (safe) return with_block(*safe, {}, DrivingKind::kUnspecified, nullptr);
    if (before->block()->in_force()) return refuse(before->safe_value(), "release its block first");
    return std::shared_ptr<const PortStop>();
  }
  const DrivingMark said = mark ? *mark : DrivingMark{};
  auto whole = Complete(said, before.get());
  if (!whole) return whole.error();
  const bool is_its_own = is_declared && !said.safe_value;
  if (!is_its_own && !goes_over(whole->safe_value, whole->command)) {
    return refuse(whole->safe_value, said.safe_value ? "the application says the safe value of the place: correct its <driving>" : kDeclare);
  }
  const bool is_as_before = before && before->robot() && whole->safe_value.get() == before->safe_value().get() &&
                            whole->brake == before->brake() && whole->command == before->command();
  if (is_as_before) return before;
  return with_block(whole->safe_value, *whole->brake, whole->command, runtime().robot_stop().signal());
}

}  // namespace runnel
