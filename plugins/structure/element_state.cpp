#include "plugins/structure/element_state.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/element/tags.h"
#include "core/port/driving_ports.h"
#include "core/port/port_options.h"
#include "core/port/port_stop.h"
#include "core/port/probe_port.h"
#include "core/port/stand_in.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

namespace {

/// Of a port, among what is noted.
struct PortState final : Annotation {
  explicit PortState(const Port& port) : type(port.type()), direction(port.direction()), is_proxy(port.is_proxy()) {}
  [[nodiscard]] bool Fits(const Port& port) const {
    return &port.type() == &type && port.direction() == direction && port.is_proxy() == is_proxy;
  }
  const TypeInfo& type;
  const Port::Direction direction;
  const bool is_proxy;
  std::string unit;
  InputLimits limits;
  // With its own stamp, so that it does not become a command from after a STOP.
  std::optional<Port::HandValue> by_hand;
  // Not of what is copied: no rule knows the copy. Rules act when something changes, and would not set it again.
  std::optional<Port::HandValue> by_rule;
  std::shared_ptr<const PortStop> stop;
  std::optional<DrivingMark> mark;
  std::shared_ptr<const DrivingMark> said;
  bool is_blocked = false;
};

Result<void> GiveTo(Port& port, const PortState& state) {
  const bool is_input = !port.is_proxy() && port.direction() == Port::Direction::kInput;
  if (is_input) {
    if (auto set = port.SetLimits(state.limits); !set) return set;
  }
  // What its module declares is its module's business: one in its place may declare another safe value.
  const PortStop* const stop = state.stop && state.stop->robot() ? state.stop.get() : nullptr;
  if (stop != nullptr && (state.mark || !port.is_driving())) {
    const DrivingMark mark = state.mark ? *state.mark : DrivingMark{stop->safe_value(), stop->brake(), stop->command()};
    if (auto set = port.SetDriving(true, mark.safe_value, mark.brake, mark.command); !set) return set;
    DrivingState::Of(port).mark = state.said;  // nobody has said what is only from a module that was there before
  }
  // What was published before a block was released counts no more afterwards either.
  if (state.stop && state.stop->block()->bar() != StopSignal::kNever) {
    if (auto blocked = port.Block(); !blocked) return blocked;
    if (!state.is_blocked) port.Unblock();
  }
  const auto give = [&](const std::optional<Port::HandValue>& by, Port::Setter setter) {
    if (!by) return Result<void>();
    // It is at rest, or might be.
    const bool rests = state.stop && port.stop() && (by->is_at_rest || setter == Port::Setter::kRule) &&
                       ToText(port.type(), by->value.get()) == ToText(port.type(), state.stop->safe_value().get());
    return port.PublishByHand(FillWith(rests ? port.stop()->safe_value() : by->value), setter, by->timestamp);
  };
  if (auto given = give(state.by_rule, Port::Setter::kRule); !given) return given;
  return give(state.by_hand, Port::Setter::kPerson);
}

void Note(FrameworkElement& noted, const FrameworkElement& element, FrameworkElement::Inherit how,
          ElementState::Below below) {
  if (const auto* const port = dynamic_cast<const Port*>(&element)) {
    auto state = std::make_unique<PortState>(*port);
    state->unit = port->unit();
    state->limits = port->limits();
    state->by_hand = port->ValueByHand();
    if (how == FrameworkElement::Inherit::kAsReplacement) state->by_rule = port->ValueByHand(Port::Setter::kRule);
    state->stop = port->stop();
    state->mark = port->FindMark();
    state->said = DrivingState::MarkOf(*port);
    state->is_blocked = port->is_blocked();
    noted.Annotate(std::move(state));
  }
  if (below == ElementState::Below::kLeftOut) return;
  for (const FrameworkElement* child : element.children()) {
    Note(noted.runtime().Create<FrameworkElement>(noted, child->name()), *child, how, below);
  }
}

Result<void> Give(const FrameworkElement& noted, FrameworkElement& made, const ElementState::TakenOver& taken_over) {
  auto* const port = dynamic_cast<Port*>(&made);
  const bool has_its_own = std::ranges::any_of(taken_over, [&](const auto& each) { return each.second == port; });
  const auto* const state = noted.FindAnnotation<PortState>();
  if (port != nullptr && state != nullptr && !has_its_own && state->Fits(*port)) {
    DrivingState::Of(*port).is_replaced = false;
    if (auto given = GiveTo(*port, *state); !given) return given;
  }
  for (const FrameworkElement* child : noted.children()) {
    FrameworkElement* const counterpart = made.FindChild(child->name());
    if (counterpart == nullptr) continue;
    if (auto given = Give(*child, *counterpart, taken_over); !given) return given;
  }
  return {};
}

}  // namespace

ElementState::ElementState(const FrameworkElement& element, Inherit how, Below below)
    : how_(how),
      noted_(std::make_unique<FrameworkElement>(Placement{element.runtime().root(), element.name(), false})) {
  Note(*noted_, element, how, below);
  noted_->InheritAnnotations(element, how);
}

void ElementState::GiveAnnotations(FrameworkElement& made) const { made.InheritAnnotations(*noted_, how_); }

Result<void> ElementState::GivePorts(FrameworkElement& made, const TakenOver& taken_over) const {
  return Give(*noted_, made, taken_over);
}

void ElementState::NoteWayBack(FrameworkElement& made) const {
  made.VisitAll<Port>([&](Port& port) {
    const auto found = noted_->Find(port.path().substr(made.path().size() + 1));
    const auto* const state = found ? (*found)->FindAnnotation<PortState>() : nullptr;
    if (state == nullptr || port.is_proxy() || !state->Fits(port) || state->unit != port.unit()) return;
    auto& driving = DrivingState::Of(port);
    driving.mark = state->said;
    driving.is_replaced = true;
    driving.is_later = driving.may_be_refused = true;
    driving.stop_before = state->stop;
  });
}

bool IsRecorded(const Port& port) {
  return std::ranges::any_of(port.outgoing(), [](const Connection& each) {
    return dynamic_cast<const ProbePort*>(each.to) != nullptr &&
           each.to->parent()->FindAnnotation<NotSaved>() != nullptr;
  });
}

bool IsOffered(const Port& port) {
  const auto* const known = port.runtime().root().FindAnnotation<ExtensionChanges>();
  return known != nullptr && known->is_offered && known->is_offered(port);
}

std::string WhatIsSetAt(const Port& port) {
  std::string text;
  const auto add = [&](bool is_set, const char* what) {
    if (is_set) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(port.is_blocked(), "its block");
  add(port.is_driving(), "its mark as driving");
  add(port.is_set_by_hand(), "its value by hand");
  add(port.is_set_by_hand(Port::Setter::kRule), "its value by a rule");
  const auto* const given = port.FindAnnotation<GivenLimits>();
  add(given != nullptr && given->limits.has_some(), "its limits");
  add(!TagsOf(port).empty(), "its tags");
  add(IsRecorded(port), "its recording");
  add(IsOffered(port), "its offer");
  return text;
}

}  // namespace runnel::internal
