// What stands in the place of a composite, or of a module that is one from now on.

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/paths/path_search.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

void Plan::WarnOfLost(FrameworkElement& before, const std::function<bool(const Port&)>& is_kept) {
  before.Visit([&](FrameworkElement& each) {
    const auto* const port = dynamic_cast<const Port*>(&each);
    if (port == nullptr || is_kept(*port)) return;
    if (const std::string what = WhatIsSetAt(*port); !what.empty()) {
      warnings_.push_back({.message = what + " went with it: the new module has no such port", .path = port->path()});
    }
  });
}

// A module has its ports in groups, a composite has not: the port of the same name, if that is of the same type.
Port* Plan::FindInInterface(const Port& port, const FrameworkElement& before, FrameworkElement& made) {
  const bool is_in_interface = before.kind() != ElementKind::kGroup || port.parent() == &before;
  const bool is_input = port.direction() == Port::Direction::kInput;
  const auto found = PathSearch(made).FindPort(port.name(), is_input ? PathKind::kInput : PathKind::kOutput);
  return is_in_interface && found && &(*found)->type() == &port.type() ? *found : nullptr;
}

// To the ports that are not at the same place.
void Plan::GiveInterface(FrameworkElement& before, FrameworkElement& made) {
  using Given = std::vector<std::pair<std::shared_ptr<const ElementState>, Port*>>;
  auto given = std::make_shared<Given>();
  before.Visit([&](FrameworkElement& each) {
    const auto* const port = dynamic_cast<const Port*>(&each);
    if (port == nullptr || ElementState::FindCounterpart(*port, before, made) != nullptr) return;
    Port* const counterpart = FindInInterface(*port, before, made);
    if (counterpart == nullptr || WhatIsSetAt(*port).empty()) return;
    given->emplace_back(
        std::make_shared<const ElementState>(*port, ElementState::Inherit::kAsReplacement, ElementState::Below::kIncluded), counterpart);
  });
  steps_.push_back({[given]() -> Result<void> {
                      for (const auto& [state, port] : *given) {
                        state->GiveAnnotations(*port);
                        if (auto done = state->GivePorts(*port); !done) return done;
                      }
                      return {};
                    },
                    [] {}, [](auto&) { return ChangeSet(); }});
}

// What a composite consists of is its own: only its interface is connected anew, and modules keep no state. What has been set
// at its ports, those within included, goes to the port of the same place and kind.
Result<void> Plan::ExchangeComposite(FrameworkElement& before, New after, Misfits misfits) {
  FrameworkElement& made = **after;
  std::vector<Connection> ties;
  for (const Connection& tie : ExternalConnectionsOf(before)) {
    Port& own = tie.from->IsAtOrBelow(before) ? *tie.from : *tie.to;
    // A module has its ports in groups, a composite has not.
    const auto found = PathSearch(made).FindPort(
        own.name(), &own == tie.from ? PathKind::kOutput : PathKind::kInput);
    Port* const port = found && own.IsAtOrBelow(before) ? *found : nullptr;
    if (auto cut = CheckTie(*tie.from, *tie.to, std::nullopt); !cut) return cut;
    if (port != nullptr) {
      ties.push_back(&own == tie.from ? Connection{port, tie.to, tie.options}
                                      : Connection{tie.from, port, tie.options});
    } else if (misfits == Misfits::kAreRefused) {
      return Error{.message = "the new module has no port '" + own.name() + "', which is connected",
                   .path = own.path()};
    } else {
      warnings_.push_back({.message = "is not connected to " + tie.to->path() +
                                      " any more: the module made anew has no such port",
                           .path = tie.from->path()});
    }
  }
  Concern(before);
  overlay_.Remove(before);
  AddRemoval(before);
  GiveInterface(before, made);
  WarnOfLost(before, [&](const Port& port) {
    return ElementState::FindCounterpart(port, before, made) != nullptr || FindInInterface(port, before, made) != nullptr;
  });
  AddCreation(std::move(after), nullptr,
              std::make_shared<const ElementState>(before, ElementState::Inherit::kAsReplacement, ElementState::Below::kIncluded));
  for (const Connection& tie : ties) {
    if (auto tied = CheckTie(*tie.from, *tie.to, tie.options); !tied) return tied;
  }
  return {};
}

}  // namespace runnel::internal
