#include "plugins/structure/element_state.h"

#include <memory>
#include <utility>

#include "core/element/runtime.h"
#include "core/element/tags.h"
#include "core/port/given_limits.h"
#include "core/types/type_info.h"
#include "core/types/value_copy.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel::internal {

namespace {

/// Of a port, among what is noted.
struct PortState final : Annotation {
  InputLimits limits;
  AnyValue by_hand;
};

AnyValue ValueByHand(const Port& port) {
  AnyValue value;
  if (!port.is_set_by_hand() || !port.type().is_transparent()) return value;
  for (const Port* shown : port.ShownPorts()) {
    shown->VisitLatest([&](const void* latest, ValueTimes) {
      const std::shared_ptr<void> copy = port.type().Make();
      if (copy && CopyValue(port.type(), latest, copy.get())) value = {port.type(), copy};
    });
  }
  return value;
}

void Note(FrameworkElement& noted, const FrameworkElement& element, FrameworkElement::Inherit how,
          ElementState::Below below) {
  if (const auto* const port = dynamic_cast<const Port*>(&element)) {
    auto state = std::make_unique<PortState>();
    state->limits = port->limits();
    state->by_hand = ValueByHand(*port);
    noted.Annotate(std::move(state));
  }
  if (below == ElementState::Below::kLeftOut) return;
  for (const FrameworkElement* child : element.children()) {
    Note(noted.runtime().Create<FrameworkElement>(noted, child->name()), *child, how, below);
  }
}

Result<void> Give(const FrameworkElement& noted, FrameworkElement& made) {
  auto* const port = dynamic_cast<Port*>(&made);
  const auto* const state = noted.FindAnnotation<PortState>();
  if (port != nullptr && state != nullptr) {
    const bool is_input = !port->is_proxy() && port->direction() == Port::Direction::kInput;
    if (is_input) {
      if (auto set = port->SetLimits(state->limits); !set) return set;
    }
    if (state->by_hand) {
      if (auto published = PublishByHand(*port, state->by_hand.get()); !published) return published;
    }
  }
  for (const FrameworkElement* child : noted.children()) {
    FrameworkElement* const counterpart = made.FindChild(child->name());
    if (counterpart == nullptr) continue;
    if (auto given = Give(*child, *counterpart); !given) return given;
  }
  return {};
}

}  // namespace

ElementState::ElementState(const FrameworkElement& element, Inherit how, Below below)
    : how_(how),
      noted_(std::make_unique<FrameworkElement>(
          Placement{element.runtime().root(), element.name(), false})) {
  Note(*noted_, element, how, below);
  noted_->InheritAnnotations(element, how);
}

Result<void> ElementState::GivePorts(FrameworkElement& made) const { return Give(*noted_, made); }

std::string WhatIsSetAt(const Port& port) {
  std::string text;
  const auto add = [&](bool is_set, const char* what) {
    if (is_set) text += (text.empty() ? "" : ", ") + std::string(what);
  };
  add(port.is_set_by_hand(), "its value by hand");
  add(port.FindAnnotation<GivenLimits>() != nullptr, "its limits");
  add(!TagsOf(port).empty(), "its tags");
  return text;
}

}  // namespace runnel::internal
