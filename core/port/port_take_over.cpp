// One port in the place of another (Port::TakeOver()).

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/check.h"
#include "core/conversion/number_conversion.h"
#include "core/element/runtime.h"
#include "core/port/converted_flow.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

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
  // A module in between may not have known its unit.
  const auto stop = port.StopInPlaceOf(from);
  const DrivingKind known = DrivingKindByUnits(port.type(), port.unit());
  if (stop && stop->robot() && internal::IsNumber(port.type()) && known != DrivingKind::kUnspecified && known != stop->command()) {
    return CannotTakeOver(port, "is in " + port.unit() + " and cannot take over from " + from.path() + ", by which something moves as by a " +
                                    DrivingKindNames()[static_cast<std::size_t>(stop->command()) - 1]);
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
  std::shared_ptr<const PortStop> after = StopInPlaceOf(from);
  if (after) from.Extras();  // which this port has then
  const bool is_marked = internal::MarkedAsDriving::Is(*this), was_marked = internal::MarkedAsDriving::Is(from);
  if (is_marked || was_marked) {
    Annotate(std::make_unique<internal::MarkedAsDriving>(is_marked));
    from.Annotate(std::make_unique<internal::MarkedAsDriving>(was_marked));
  }
  ExchangeConnections(from, sinks);
  try {
    TakeOverFlow(from);
    if (after != before) {
      extras_->stop = std::move(after);
      RebindSinks();
    }
    // What moves by what its module passes on may be something else now.
    const auto has_moved = [](const Port* each) { return each->motion_beginnings() != 0; };
    const bool is_output = !is_proxy() && direction_ == Direction::kOutput, is_input = !is_proxy() && direction_ == Direction::kInput;
    if (is_output && has_moved(this)) VisitSiblings(*this, Direction::kInput, [](Port& each) { each.RebindSinks(); });
    bool moves = false;
    if (is_input) VisitSiblings(*this, Direction::kOutput, [&](const Port& each) { moves = moves || has_moved(&each); });
    if (moves) RebindSinks();
  } catch (...) {
    // Each as it was, and what has been exchanged by then is exchanged again.
    if (extras_) extras_->stop = before;
    from.ExchangeConnections(*this, sinks);
    from.TakeOverFlow(*this);
    throw;
  }
  if (is_marked == was_marked) return;
  FindAnnotation<internal::MarkedAsDriving>()->is_marked = was_marked;
  from.FindAnnotation<internal::MarkedAsDriving>()->is_marked = is_marked;
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

// What stops this port in the place of the other: what its own module declares, with the block of the place. What an
// application has marked stays as it is.
std::shared_ptr<const PortStop> Port::StopInPlaceOf(const Port& from) const {
  const std::shared_ptr<const PortStop> before = from.stop();
  const PortStop* const declared = declared_stop();
  const bool is_kept = declared == nullptr || (before && before->robot() && internal::MarkedAsDriving::Is(from));
  if (is_kept) return before;
  return std::make_shared<PortStop>(declared->safe_value(), declared->brake(), declared->command(), declared->robot(), before.get());
}

}  // namespace runnel
