#include "plugins/genom_description/component_rules.h"

#include <algorithm>

#include "core/base/nearest_name.h"

namespace runnel::genom {

Component* ComponentRules::Open(const Token& name, bool is_interface) {
  Scope* scope = description_.scopes.EnterModule(name.text, name.place);
  current_ = description_.FindComponent(name.text);
  if (current_ != nullptr && current_->is_interface != is_interface) {
    problems_.Add(name.place, "'" + name.text + "' is a component and an interface",
                  problems_.DeclaredAt(current_->place));
    current_ = nullptr;
  }
  if (current_ == nullptr) {
    Component& component = description_.components.emplace_back();
    component.place = name.place;
    component.name = name.text;
    component.is_interface = is_interface;
    component.scope = scope;
    current_ = &component;
    DeclareStandardEvents(component);
  }
  current_->is_open = true;
  is_codel_left_out_ = false;
  const PropertyOwner owner = is_interface ? PropertyOwner::kInterface : PropertyOwner::kComponent;
  for (const Property& each : for_all_) AddProperty(current_->properties, each, owner, problems_);
  if (!is_interface) {
    for (Component* each : provided_by_all_) Merge(*each, PropertyKind::kProvides);
  }
  return current_;
}

void ComponentRules::DeclareStandardEvents(Component& component) {
  component.ids_scope = description_.scopes.EnterMembers("ids", component.place, TypeKind::kStruct);
  description_.scopes.Leave();
  if (component.is_interface) return;
  for (const char* name : {"ether", "start", "stop"}) {
    (void)Event({.kind = Token::Kind::kWord, .text = name, .place = component.place}, false);
  }
  component.pause_scope = description_.scopes.EnterModule("pause", component.place);
  description_.scopes.Leave();
}

Type* ComponentRules::Event(const Token& name, bool is_pause) {
  Scopes& scopes = description_.scopes;
  if (is_pause && name.text == "ether") {
    problems_.Add(name.place, "nothing can pause before 'ether', where an activity has ended", "write ether");
    return nullptr;
  }
  if (is_pause) {
    if (current_->pause_scope == nullptr) {
      current_->pause_scope = scopes.EnterModule("pause", name.place);
      scopes.Leave();
    }
    scopes.Enter(current_->pause_scope);
  }
  const TypeKind kind = is_pause ? TypeKind::kPauseEvent : TypeKind::kEvent;
  const auto before = scopes.current()->types.find(name.text);
  Type* event = before != scopes.current()->types.end() && before->second->kind == kind
                    ? before->second
                    : scopes.Declare(kind, name.text, name.place);
  scopes.Enter(current_->scope);
  return event;
}

bool ComponentRules::AddComponentProperty(Property property) {
  const PropertyOwner owner = current_->is_interface ? PropertyOwner::kInterface : PropertyOwner::kComponent;
  const PropertyKind kind = property.kind;
  const std::vector<Component*> interfaces = property.interfaces;
  if (!AddProperty(current_->properties, std::move(property), owner, problems_)) return false;
  for (Component* each : interfaces) Merge(*each, kind);
  return true;
}

void ComponentRules::AddIdsMember(const Token& name, Type* type) {
  Scopes& scopes = description_.scopes;
  scopes.Enter(current_->scope);
  if (current_->ids == nullptr) {
    current_->ids = scopes.Declare(TypeKind::kStruct, "ids", name.place);
    if (current_->ids == nullptr) {
      scopes.Enter(current_->ids_scope);
      return;
    }
    current_->ids->scope = current_->ids_scope;
  }
  scopes.Enter(current_->ids_scope);
  Type* member = scopes.Declare(TypeKind::kMember, name.text, name.place);
  if (member == nullptr) return;
  member->type = type;
  current_->ids->members.push_back(member);
}

// Ports and remotes have names among types and events; services must differ from these two.
bool ComponentRules::IsNameUsed(std::string_view name, Place place, bool is_service) {
  Place before;
  if (const Port* port = FindByName(current_->ports, name)) {
    before = port->place;
  } else if (const Remote* remote = FindByName(current_->remotes, name)) {
    before = remote->place;
  } else if (const Service* service = FindByName(current_->services, name); service != nullptr && !is_service) {
    before = service->place;
  } else {
    return false;
  }
  problems_.Add(place, "there is '" + std::string(name) + "' already", problems_.DeclaredAt(before));
  return true;
}

void ComponentRules::AddPort(Port port, Properties properties) {
  if (IsNameUsed(port.name, port.place, false)) return;
  if (port.type->name.empty()) {
    problems_.Add(port.place, "the type of a port needs a name, unlike " + port.type->ShownName(),
                  "give it one: typedef " + port.type->ShownName() + " NAME");
    return;
  }
  if (Holds(port.type, TypeKind::kNative)) {
    problems_.Add(port.place, "what a port carries cannot be native, nor hold something native");
    return;
  }
  port.entry = description_.scopes.Declare(TypeKind::kPort, port.name, port.place);
  if (port.entry == nullptr) return;
  port.entry->type = port.type;
  port.doc = TextOf(properties, PropertyKind::kDoc);
  current_->ports.push_back(&description_.ports.emplace_back(std::move(port)));
}

void ComponentRules::AttachCodels(const Properties& properties, Task* task, Service* service) {
  for (Codel* codel : CodelsOf(properties)) {
    codel->component = current_;
    codel->service = service;
    codel->task = codel->kind == CodelKind::kStateMachine ? task : nullptr;
    codels_.try_emplace(codel->name, codel);
  }
}

void ComponentRules::AddTask(Task draft) {
  Task* task = FindByName(current_->tasks, draft.name);
  if (task == nullptr) {
    task = &description_.tasks.emplace_back();
    task->place = draft.place;
    task->name = draft.name;
    task->component = current_;
    current_->tasks.push_back(task);
  }
  for (Property& each : draft.properties) {
    AddProperty(task->properties, std::move(each), PropertyOwner::kTask, problems_);
  }
  AttachCodels(task->properties, task, nullptr);
}

bool ComponentRules::Agree(const Service& draft, const Service& before) {
  const auto proper = [](const Service& service) {
    std::vector<const Parameter*> parameters;
    for (const Parameter& each : service.parameters) {
      if (!each.is_variable) parameters.push_back(&each);
    }
    return parameters;
  };
  const std::string where = problems_.DeclaredAt(before.place);
  const std::string name = std::string(NameOf(draft.kind)) + " '" + draft.name + "'";
  if (draft.kind != before.kind) {
    problems_.Add(draft.place, name + " has been declared as " + std::string(NameOf(before.kind)), where);
    return false;
  }
  const auto now = proper(draft);
  const auto then = proper(before);
  for (std::size_t i = 0; i < std::min(now.size(), then.size()); ++i) {
    const bool is_same = now[i]->name == then[i]->name && now[i]->direction == then[i]->direction &&
                         AreSame(now[i]->type, then[i]->type);
    if (is_same) continue;
    problems_.Add(now[i]->place, "parameter '" + now[i]->name + "' of " + name + " is not the one declared before",
                  "which is " + std::string(NameOf(then[i]->direction)) + " " + then[i]->type->ShownName() + " " +
                      then[i]->name + "; " + problems_.DeclaredAt(then[i]->place));
    return false;
  }
  if (now.size() == then.size()) return true;
  problems_.Add(draft.place,
                name + " has been declared with " + std::to_string(then.size()) + " parameters, not " +
                    std::to_string(now.size()),
                where);
  return false;
}

bool ComponentRules::CheckServiceCodels(const Service& service) {
  bool is_right = true;
  for (const Codel* codel : CodelsOf(service.properties)) {
    if (codel->kind == CodelKind::kStateMachine) continue;
    for (const Parameter& each : codel->parameters) {
      if (each.source != ParameterSource::kPort && each.source != ParameterSource::kRemote) continue;
      problems_.Add(each.place,
                    std::string(NameOf(each.source)) + " '" + each.name + "' is nothing for a " +
                        std::string(NameOf(codel->kind)) + " codel",
                    "only codels with states use ports and remotes");
      is_right = false;
    }
  }
  return is_right;
}

void ComponentRules::AddService(Service draft) {
  if (draft.name == "all") {
    problems_.Add(draft.place, "no service can be called 'all'",
                  "'all' means every service, in interrupts, before, after");
    return;
  }
  if (IsNameUsed(draft.name, draft.place, true) || !CheckServiceCodels(draft)) return;
  for (const Parameter& each : draft.parameters) {
    if (each.is_variable || !Holds(each.type, TypeKind::kNative)) continue;
    problems_.Add(each.place, "parameter '" + each.name + "' cannot be native, nor hold something native",
                  "only the ids and codels have native types");
    return;
  }
  Service* service = FindByName(current_->services, draft.name);
  if (service == nullptr) {
    service = &description_.services.emplace_back();
    service->place = draft.place;
    service->name = draft.name;
    service->kind = draft.kind;
    service->component = current_;
    service->parameters = std::move(draft.parameters);
    current_->services.push_back(service);
  } else {
    if (!Agree(draft, *service)) return;
    for (Parameter& each : draft.parameters) {
      if (FindParameter(service->parameters, each.name) == nullptr) service->parameters.push_back(std::move(each));
    }
  }
  for (Property& each : draft.properties) {
    AddProperty(service->properties, std::move(each), OwnerOf(service->kind), problems_);
  }
  AttachCodels(service->properties, service->task(), service);
}

void ComponentRules::CheckNames(const Service& service) {
  for (const Property& each : service.properties) {
    if (each.kind != PropertyKind::kInterrupts && each.kind != PropertyKind::kBefore &&
        each.kind != PropertyKind::kAfter) {
      continue;
    }
    for (std::size_t i = 0; i < each.texts.size(); ++i) {
      if (each.texts[i] == "all" || FindByName(current_->services, each.texts[i]) != nullptr) continue;
      problems_.Add(each.places[i], "there is no service '" + each.texts[i] + "'",
                    NearestNameHint(each.texts[i], NamesOf(current_->services, &Service::name)));
    }
  }
}

void ComponentRules::Close() {
  Component& component = *current_;
  const bool is_complete = !component.is_interface;
  const bool has_machines = is_complete && !is_codel_left_out_;
  for (Task* each : component.tasks) {
    BuildStateMachine(CodelsOf(each->properties), each->states, problems_);
    if (has_machines) CheckStateMachine(each->states, false, each->place, problems_);
  }
  for (Service* each : component.services) {
    CheckNames(*each);
    BuildStateMachine(CodelsOf(each->properties), each->states, problems_);
    if (!is_complete || each->kind != ServiceKind::kActivity) continue;
    if (each->task() == nullptr) {
      problems_.Add(each->place, "activity '" + each->name + "' runs in no task", "say in which: task NAME;");
    }
    if (has_machines) CheckStateMachine(each->states, true, each->place, problems_);
  }
  CheckTimes(component, problems_);
  if (is_complete) {
    CheckAsyncCodels(component, problems_);
    WarnOfCodelNames(component, problems_);
    WarnOfServicesThatNeverStart(component, problems_);
  }
  component.is_open = false;
  current_ = nullptr;
  description_.scopes.Leave();
}

}  // namespace runnel::genom
