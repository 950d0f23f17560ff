#include "plugins/structure/plan.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "plugins/structure/replacement.h"

namespace runnel::internal {

namespace {

ConnectOptions OptionsOf(const Port& from, const Port& to) {
  const auto found = std::ranges::find(from.outgoing(), &to, &Connection::to);
  return found != from.outgoing().end() ? found->options : ConnectOptions{};
}

// nullptr if it is the last.
const FrameworkElement* NextSibling(const FrameworkElement& element) {
  const auto& siblings = element.parent()->children();
  const auto next = std::next(std::ranges::find(siblings, &element));
  return next == siblings.end() ? nullptr : *next;
}

}  // namespace

std::vector<Connection> TiesOf(FrameworkElement& element) {
  std::vector<Connection> ties;
  element.Visit([&](FrameworkElement& each) {
    auto* const port = dynamic_cast<Port*>(&each);
    if (port == nullptr) return;
    for (const Connection& edge : port->outgoing()) {
      if (!edge.to->IsAtOrBelow(element)) ties.push_back(edge);
    }
    for (Port* from : port->incoming()) {
      if (!from->IsAtOrBelow(element)) ties.push_back({from, port, OptionsOf(*from, *port)});
    }
  });
  return ties;
}

void Plan::Make(const ChangeSet& changes, const std::vector<SourcePosition>& places,
                Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto tell = [&](Error error) {
      if (i < places.size() && !places[i].file.empty()) error.position = places[i];
      diagnostics.Add(std::move(error));
    };
    try {
      const auto check = [this](const auto& change) { return Check(change); };
      if (const auto possible = std::visit(check, changes[i]); !possible) tell(possible.error());
    } catch (const std::exception& exception) {
      tell({.message = exception.what()});
    }
    for (Error& each : further_errors_) tell(std::move(each));
    further_errors_.clear();
  }
  if (diagnostics.ok()) WarnOfMissingSources(diagnostics);
}

Result<void> Plan::Carry(Inverse* inverse) {
  const ChangeScope all_at_once(runtime_);
  for (std::size_t done = 0; done < steps_.size(); ++done) {
    Result<void> result;
    try {
      if (inverse != nullptr) {
        inverse->of_steps.push_back(steps_[done].inverse(inverse->why_not));
      }
      result = steps_[done].apply();
    } catch (const std::exception& exception) {
      result = Error{.message = exception.what()};
    }
    if (result) continue;
    while (done > 0) steps_[--done].undo();
    return result;
  }
  return {};
}

void Plan::Concern(const FrameworkElement& element) {
  const FrameworkElement* module = &element;
  while (module->parent() != nullptr && module->kind() != ElementKind::kModule &&
         module->kind() != ElementKind::kGroup) {
    module = module->parent();
  }
  // Ports of a group's interface: whoever is at their far ends.
  if (const auto* const port = dynamic_cast<const Port*>(&element); port && port->is_proxy()) {
    for (const Port* end : port->Sources()) Concern(*end);
    for (const Port* end : port->Sinks()) Concern(*end);
    return;
  }
  if (std::ranges::find(concerned_, module->path()) == concerned_.end()) {
    concerned_.push_back(module->path());
  }
}

void Plan::WarnOfMissingSources(Diagnostics& diagnostics) const {
  for (FrameworkElement* each : made_) {
    each->Visit([&](FrameworkElement& element) {
      const auto* const port = dynamic_cast<const Port*>(&element);
      if (port == nullptr || !port->is_required() || projection_.HasSource(*port)) return;
      diagnostics.AddWarning(
          {.message = "is required, and nothing is connected to it", .path = port->path()});
    });
  }
}

void Plan::AddCreation(UnlistedElement element) {
  FrameworkElement& made = *element;
  projection_.Add(made);
  made_.push_back(&made);
  auto kept = std::make_shared<UnlistedElement>(std::move(element));
  steps_.push_back({[this, kept]() -> Result<void> {
                      const auto listed = runtime_.List(std::move(*kept));
                      return listed ? Result<void>() : listed.error();
                    },
                    [this, kept, &made] { *kept = *runtime_.Unlist(made); },
                    [&made](auto&) -> ChangeSet { return {DeleteElement{made.path()}}; }});
}

void Plan::AddConnection(Port& from, Port& to, const ConnectOptions& options) {
  Concern(from);
  Concern(to);
  steps_.push_back({[&from, &to, options] { return Port::Connect(from, to, options); },
                    [&from, &to] { (void)Port::Disconnect(from, to); },
                    [&from, &to](auto&) -> ChangeSet {
                      return {DisconnectPorts{from.path(), to.path()}};
                    }});
}

void Plan::AddDisconnection(Port& from, Port& to) {
  Concern(from);
  Concern(to);
  auto options = std::make_shared<ConnectOptions>();
  steps_.push_back({[&from, &to, options] {
                      *options = OptionsOf(from, to);
                      return Port::Disconnect(from, to);
                    },
                    [&from, &to, options] { (void)Port::Connect(from, to, *options); },
                    [&from, &to](auto&) -> ChangeSet {
                      return {ConnectPorts{from.path(), to.path(), OptionsOf(from, to)}};
                    }});
}

// What goes with it stays as it is among itself; what ties it to others is cut.
void Plan::AddRemoval(FrameworkElement& element) {
  struct Undo {
    std::vector<Connection> ties;
    const FrameworkElement* place = nullptr;
  };
  auto undo = std::make_shared<Undo>();
  steps_.push_back({[=, this, &element]() -> Result<void> {
                      *undo = {TiesOf(element), NextSibling(element)};
                      for (const Connection& tie : undo->ties) {
                        (void)Port::Disconnect(*tie.from, *tie.to);
                      }
                      auto taken = runtime_.Unlist(element);
                      if (!taken) return taken.error();
                      removed_.push_back(std::move(*taken));
                      return {};
                    },
                    [=, this] {
                      (void)runtime_.List(std::move(removed_.back()), undo->place);
                      removed_.pop_back();
                      for (const Connection& tie : undo->ties) {
                        (void)Port::Connect(*tie.from, *tie.to, tie.options);
                      }
                    },
                    [&element](auto& why_not) { return MakeAgain(element, why_not); }});
}

void Plan::AddReplacement(FrameworkElement& before, UnlistedElement after,
                          std::vector<std::pair<Port*, Port*>> ports, const ReplaceModule& change) {
  Concern(before);
  FrameworkElement& next = *after;
  auto kept = std::make_shared<UnlistedElement>(std::move(after));
  steps_.push_back({[=, this, &before, &next, values = ValuesOf(before)]() -> Result<void> {
                      // What has been set or assigned since the new module was made, by this change set or others.
                      if (auto set = CopyLateSettings(before, values, change.settings, next); !set)
                        return set;
                      next.InheritAnnotations(before);
                      if (auto copied = CopyState(before, next); !copied) return copied;
                      const FrameworkElement* const place = NextSibling(before);
                      auto taken = runtime_.Unlist(before);
                      if (!taken) return taken.error();
                      for (const auto& [from, to] : ports) to->TakeOver(*from);
                      (void)runtime_.List(std::move(*kept), place);
                      replaced_.push_back(
                          {std::move(*taken), next.path(), next.serial(), change.probation_cycles});
                      return {};
                    },
                    [=, this, &next] {
                      const FrameworkElement* const place = NextSibling(next);
                      *kept = *runtime_.Unlist(next);
                      for (const auto& [from, to] : ports) from->TakeOver(*to);
                      (void)runtime_.List(std::move(replaced_.back().before), place);
                      replaced_.pop_back();
                    },
                    [&before, &next, cycles = change.probation_cycles](auto& why_not) {
                      return ReplaceBack(before, next, cycles, why_not);
                    }});
}

}  // namespace runnel::internal
