#include "plugins/structure/plan.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/configurable.h"
#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "core/types/type_info.h"
#include "plugins/scheduling/thread_container.h"
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

// The connections between what is at or below `element` and the rest.
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

}  // namespace

void Plan::Make(const ChangeSet& changes, Diagnostics& diagnostics) {
  for (const Change& change : changes) {
    try {
      const auto possible = std::visit([this](const auto& each) { return Check(each); }, change);
      if (!possible) diagnostics.Add(possible.error());
    } catch (const std::exception& exception) {
      diagnostics.Add({.message = exception.what()});
    }
  }
  for (Error& each : further_errors_) diagnostics.Add(std::move(each));
  if (diagnostics.ok()) WarnOfMissingSources(diagnostics);
}

Result<void> Plan::Carry() {
  const ChangeScope all_at_once(runtime_);
  for (std::size_t done = 0; done < steps_.size(); ++done) {
    Result<void> result;
    try {
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
                    [this, kept, &made] { *kept = *runtime_.Unlist(made); }});
}

void Plan::AddConnection(Port& from, Port& to, const ConnectOptions& options) {
  Concern(from);
  Concern(to);
  steps_.push_back({[&from, &to, options] { return Port::Connect(from, to, options); },
                    [&from, &to] { (void)Port::Disconnect(from, to); }});
}

void Plan::AddDisconnection(Port& from, Port& to) {
  Concern(from);
  Concern(to);
  auto options = std::make_shared<ConnectOptions>();
  steps_.push_back({[&from, &to, options] {
                      *options = OptionsOf(from, to);
                      return Port::Disconnect(from, to);
                    },
                    [&from, &to, options] { (void)Port::Connect(from, to, *options); }});
}

Result<UnlistedElement> Plan::MakeModule(const std::string& type, const Placement& placement) {
  auto made = modules_.Make(type, placement);
  if (made || !made.error().path.empty()) return made;
  Error error = made.error();
  error.path = placement.parent.path() + "/" + placement.name;
  return error;
}

Result<void> Plan::Check(const CreateModule& change) {
  const auto place = projection_.PlaceFor(change.path);
  if (!place) return place.error();
  auto made = MakeModule(change.type, *place);
  if (!made) return made.error();
  for (const Setting& each : change.settings) {
    if (auto set = Configure(**made, each); !set) return set;
  }
  if (auto prepared = Runtime::Prepare(*made); !prepared) return prepared;
  AddCreation(std::move(*made));
  return {};
}

Result<void> Plan::Check(const CreateGroup& change) {
  const auto place = projection_.PlaceFor(change.path);
  if (!place) return place.error();
  UnlistedElement made(std::make_unique<Group>(*place));
  if (auto prepared = Runtime::Prepare(made); !prepared) return prepared;
  AddCreation(std::move(made));
  return {};
}

Result<void> Plan::Check(const CreatePort& change) {
  const auto place = projection_.PlaceFor(change.path);
  if (!place) return place.error();
  const TypeInfo* const type = FindType(change.type);
  if (type == nullptr) {
    std::vector<std::string> names;
    for (const TypeInfo* each : RegisteredTypes()) names.push_back(each->name());
    return Error{.message = "there is no data type '" + change.type + "'",
                 .path = change.path,
                 .hint = NearestNameHint(change.type, names)};
  }
  UnlistedElement made(std::make_unique<ProxyPort>(*place, change.direction, *type));
  if (auto prepared = Runtime::Prepare(made); !prepared) return prepared;
  AddCreation(std::move(made));
  return {};
}

Result<void> Plan::Check(const ConnectPorts& change) {
  const auto from = projection_.FindPort(change.from, Projection::End::kSends);
  if (!from) return from.error();
  const auto to = projection_.FindPort(change.to, Projection::End::kReceives);
  if (!to) return to.error();
  if (auto possible = projection_.Connect(**from, **to); !possible) return possible;
  AddConnection(**from, **to, change.options);
  return {};
}

Result<void> Plan::Check(const DisconnectPorts& change) {
  const auto from = projection_.FindPort(change.from, Projection::End::kSends);
  if (!from) return from.error();
  const auto to = projection_.FindPort(change.to, Projection::End::kReceives);
  if (!to) return to.error();
  if (auto possible = projection_.Disconnect(**from, **to); !possible) return possible;
  AddDisconnection(**from, **to);
  return {};
}

Result<void> Plan::Check(const DeleteElement& change) {
  const auto found = projection_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  if (element.parent() == nullptr) {
    return Error{.message = "the root cannot be deleted", .path = element.path()};
  }
  const FrameworkElement& owner = *element.parent();
  const bool is_part =
      owner.kind() == ElementKind::kModule || owner.kind() == ElementKind::kPortGroup;
  if (is_part ||
      (element.kind() == ElementKind::kPort && !dynamic_cast<Port&>(element).is_proxy())) {
    return Error{.message = "a part of a module cannot be deleted by itself",
                 .path = element.path()};
  }
  Concern(element);
  for (const Connection& tie : TiesOf(element)) {
    Concern(*tie.from);
    Concern(*tie.to);
  }
  projection_.Remove(element);
  AddRemoval(element);
  return {};
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
                    }});
}

Result<void> Plan::Check(const SetParameter& change) {
  const auto found = projection_.Find(change.path);
  if (!found) return found.error();
  auto* const parameter = dynamic_cast<Configurable*>(*found);
  if (parameter == nullptr) {
    return Error{.message = (*found)->path() + " is not a parameter", .path = (*found)->path()};
  }
  if (parameter->info().is_static && (*found)->life_cycle() == LifeCycle::kReady) {
    return Error{.message = "can be set only before its module is ready",
                 .path = (*found)->path(),
                 .hint = "replace the module, by the same type, with the new value"};
  }
  if (auto accepted = parameter->CheckText(change.value); !accepted) {
    Error error = accepted.error();
    if (error.path.empty()) error.path = (*found)->path();
    return error;
  }
  Concern(**found);
  auto before = std::make_shared<std::string>();
  steps_.push_back({[parameter, before, value = change.value] {
                      *before = parameter->ToText();
                      return parameter->SetFromText(value);
                    },
                    [parameter, before] { (void)parameter->SetFromText(*before); }});
  return {};
}

Result<void> Plan::Check(const ReplaceModule& change) {
  const auto found = projection_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& before = **found;
  if (before.kind() != ElementKind::kModule) {
    return Error{.message = "is not a module and cannot be replaced by one", .path = before.path()};
  }
  auto made = MakeModule(change.type, {*before.parent(), before.name(), false});
  if (!made) return made.error();
  if (auto copied = CopySettings(before, **made); !copied) return copied;
  for (const Setting& each : change.settings) {
    if (auto set = Configure(**made, each); !set) return set;
  }
  (*made)->InheritAnnotations(before);
  if (auto prepared = Runtime::Prepare(*made); !prepared) return prepared;
  PortMatch match = MatchPorts(before, **made);
  if (!match.errors.empty()) {
    for (std::size_t i = 1; i < match.errors.size(); ++i)
      further_errors_.push_back(match.errors[i]);
    return match.errors.front();
  }
  projection_.Replace(before, **made, match.ports);
  made_.push_back(made->get());
  AddReplacement(before, std::move(*made), std::move(match.ports), change.probation_cycles);
  return {};
}

void Plan::AddReplacement(FrameworkElement& before, UnlistedElement after,
                          std::vector<std::pair<Port*, Port*>> ports,
                          std::uint64_t probation_cycles) {
  Concern(before);
  FrameworkElement& next = *after;
  auto kept = std::make_shared<UnlistedElement>(std::move(after));
  steps_.push_back(
      {[=, this, &before, &next]() -> Result<void> {
         if (auto copied = CopyState(before, next); !copied) return copied;
         const FrameworkElement* const place = NextSibling(before);
         auto taken = runtime_.Unlist(before);
         if (!taken) return taken.error();
         for (const auto& [from, to] : ports) to->TakeOver(*from);
         (void)runtime_.List(std::move(*kept), place);
         replaced_.push_back({std::move(*taken), next.path(), next.serial(), probation_cycles});
         return {};
       },
       [=, this, &next] {
         const FrameworkElement* const place = NextSibling(next);
         *kept = *runtime_.Unlist(next);
         for (const auto& [from, to] : ports) from->TakeOver(*to);
         (void)runtime_.List(std::move(replaced_.back().before), place);
         replaced_.pop_back();
       }});
}

Result<void> Plan::Check(const AssignToThread& change) {
  const auto found = projection_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  ThreadContainer* thread = nullptr;
  if (!change.thread.empty()) {
    const std::string path =
        change.thread.front() == '/' ? change.thread : "/threads/" + change.thread;
    const auto named = projection_.Find(path);
    if (!named) return named.error();
    thread = dynamic_cast<ThreadContainer*>(*named);
    if (thread == nullptr) {
      return Error{.message = (*named)->path() + " is not a thread", .path = element.path()};
    }
  }
  Concern(element);
  const auto assign = [&element](ThreadContainer* to) {
    to != nullptr ? AssignThread(element, *to) : UnassignThread(element);
  };
  auto before = std::make_shared<ThreadContainer*>(nullptr);
  steps_.push_back({[=, &element]() -> Result<void> {
                      *before = OwnThread(element);
                      assign(thread);
                      return {};
                    },
                    [=] { assign(*before); }});
  return {};
}

}  // namespace runnel::internal
