#include "plugins/behaviours/behaviour_group.h"

#include "core/element/runtime.h"

namespace runnel {

namespace {

// All signals that a group has from its characteristic behaviour.
std::vector<Port*> SignalsOf(Behaviour& behaviour) {
  std::vector<Port*> signals{&behaviour.stimulation};
  for (std::size_t i = 0; i < behaviour.inhibition_count(); ++i) signals.push_back(&behaviour.inhibition(i));
  signals.insert(signals.end(), {&behaviour.activity, &behaviour.target_rating});
  return signals;
}

Result<void> CheckSignal(const FrameworkElement& group, const Port& signal) {
  const auto* const port = dynamic_cast<const Port*>(group.FindChild(signal.name()));
  const bool is_input = signal.direction() == Port::Direction::kInput;
  const std::string tag =
      "<port name=\"" + signal.name() + "\" direction=\"" + (is_input ? "input" : "output") + "\"/>";
  if (port == nullptr || !port->is_proxy() || port->direction() != signal.direction()) {
    return Error{.message = "has no interface port '" + signal.name() + "' for its characteristic behaviour",
                 .path = group.path(),
                 .hint = "add " + tag};
  }
  if ((is_input ? port->ConnectionTo(signal) : signal.ConnectionTo(*port)) != nullptr) return {};
  return Error{.message = "is not connected with " + signal.path() + ", which speaks for the group",
               .path = port->path(),
               .hint = "add a <connect> of the two"};
}

}  // namespace

Behaviour* CharacteristicOf(const FrameworkElement& group) {
  const auto* const said = group.FindAnnotation<CharacteristicBehaviour>();
  if (said == nullptr) return nullptr;
  if (FrameworkElement* const named = group.FindChild(said->name)) return dynamic_cast<Behaviour*>(named);
  // It has been renamed: it is the one that the interface leads to.
  for (FrameworkElement* const child : group.children()) {
    auto* const behaviour = dynamic_cast<Behaviour*>(child);
    if (behaviour != nullptr && CheckBehaviourGroup(group, child->name())) return behaviour;
  }
  return nullptr;
}

Result<void> CheckBehaviourGroup(const FrameworkElement& group, const std::string& characteristic) {
  auto* const behaviour = dynamic_cast<Behaviour*>(group.FindChild(characteristic));
  if (behaviour == nullptr) {
    const bool is_there = group.FindChild(characteristic) != nullptr;
    return Error{
        .message = "its characteristic behaviour '" + characteristic + (is_there ? "' is none" : "' is not there"),
        .path = group.path(),
        .hint = "it is a module that is a behaviour, directly in the group"};
  }
  for (const Port* const signal : SignalsOf(*behaviour)) {
    if (auto checked = CheckSignal(group, *signal); !checked) return checked;
  }
  return {};
}

Result<void> BehaviourGroup::Characterise(Behaviour& characteristic) {
  if (const auto* const said = FindAnnotation<CharacteristicBehaviour>()) {
    return Error{.message = "'" + said->name + "' speaks for it already", .path = path()};
  }
  if (characteristic.parent() != this) {
    return Error{.message = characteristic.path() + " is not directly within, and cannot speak for it", .path = path()};
  }
  if (auto constructed = Runtime::Construct(characteristic); !constructed) return constructed;
  std::vector<Port*> signals = SignalsOf(characteristic);
  signals.push_back(&characteristic.state);  // for viewers
  for (Port* const signal : signals) {
    ProxyPort& port = ports_.emplace_back(Placement{*this, signal->name()}, signal->direction(), signal->type(),
                                          signal->description());
    const bool is_input = signal->direction() == Port::Direction::kInput;
    auto connected = is_input ? Port::Connect(port, *signal) : Port::Connect(*signal, port);
    if (!connected) return connected;
  }
  mode_ = std::make_unique<GroupParameter>(Placement{*this, "stimulation_mode"},
                                           std::vector{characteristic.name() + "/stimulation_mode"},
                                           "who decides how much it is stimulated");
  Annotate(std::make_unique<CharacteristicBehaviour>(characteristic.name()));
  return {};
}

}  // namespace runnel
