// What interfaces bring into components: as if it were written there, or turned round where it is used.

#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

void ComponentRules::Merge(Component& interface, PropertyKind how) {
  if (interface.is_open) {
    problems_.Add(current_->place, "interface '" + interface.name + "' cannot extend itself");
    return;
  }
  const PropertyOwner owner = current_->is_interface ? PropertyOwner::kInterface : PropertyOwner::kComponent;
  for (const Property& each : interface.properties) {
    const bool is_merging =
        each.kind == PropertyKind::kProvides || each.kind == PropertyKind::kUses || each.kind == PropertyKind::kExtends;
    if (!is_merging) AddProperty(current_->properties, each, owner, problems_);
  }
  const bool is_used = how == PropertyKind::kUses;
  MergeIds(interface);
  MergePorts(interface, is_used);
  for (const Remote* each : interface.remotes) {
    AddRemote({.place = each->place, .name = each->name, .kind = each->kind, .parameters = each->parameters});
  }
  for (const Task* each : interface.tasks) {
    AddTask({.place = each->place, .name = each->name, .properties = CopiedProperties(each->properties, {})});
  }
  MergeServices(interface, is_used);
}

void ComponentRules::MergeIds(const Component& interface) {
  if (interface.ids == nullptr) return;
  for (const Type* each : interface.ids->members) {
    const Type* before = current_->ids == nullptr ? nullptr : MemberOf(current_->ids, each->name);
    if (before != nullptr && before->type == each->type) continue;
    AddIdsMember({.kind = Token::Kind::kWord, .text = each->name, .place = each->place}, each->type);
  }
  description_.scopes.Enter(current_->scope);
}

void ComponentRules::MergePorts(const Component& interface, bool is_turned) {
  for (const Port* each : interface.ports) {
    Port port = *each;
    port.interface = interface.name;
    if (is_turned) port.is_input = !port.is_input;
    Properties properties;
    if (!each->doc.empty()) properties.push_back({.kind = PropertyKind::kDoc, .text = each->doc});
    AddPort(std::move(port), std::move(properties));
  }
}

Codel* ComponentRules::Copied(const Codel& codel, const std::vector<Parameter>& locals) {
  Codel copy = codel;
  for (Parameter& each : copy.parameters) {
    if (!Resolve(each, locals)) return nullptr;
  }
  const auto own = [&](std::vector<Type*>& events) {
    for (Type*& each : events) {
      Type* event = Event({.kind = Token::Kind::kWord, .text = each->name, .place = codel.place},
                          each->Is(TypeKind::kPauseEvent));
      if (event != nullptr) each = event;
    }
  };
  own(copy.triggers);
  own(copy.yields);
  return &description_.codels.emplace_back(std::move(copy));
}

Properties ComponentRules::CopiedProperties(const Properties& properties, const std::vector<Parameter>& locals) {
  Properties copies;
  for (const Property& each : properties) {
    Property copy = each;
    if (copy.codel != nullptr) copy.codel = Copied(*copy.codel, locals);
    if (each.codel != nullptr && copy.codel == nullptr) continue;
    if (copy.task != nullptr) {
      copy.task = FindByName(current_->tasks, copy.task->name);
      if (copy.task == nullptr) continue;
    }
    copies.push_back(std::move(copy));
  }
  return copies;
}

void ComponentRules::MergeServices(const Component& interface, bool as_remotes) {
  for (const Service* each : interface.services) {
    if (as_remotes) {
      AddRemote(*each);
      continue;
    }
    Service draft{.place = each->place, .name = each->name, .kind = each->kind, .parameters = each->parameters};
    for (Parameter& parameter : draft.parameters) {
      if (parameter.source == ParameterSource::kIds) (void)Resolve(parameter, {});
    }
    draft.properties = CopiedProperties(each->properties, draft.parameters);
    AddService(std::move(draft));
  }
}

void ComponentRules::AddRemote(const Service& service) {
  if (IsNameUsed(service.name, service.place, false)) return;
  Type* entry = description_.scopes.Declare(TypeKind::kRemote, service.name, service.place);
  if (entry == nullptr) return;
  Remote& remote = description_.remotes.emplace_back();
  remote.place = service.place;
  remote.name = service.name;
  remote.kind = service.kind;
  remote.entry = entry;
  for (const Parameter& each : service.parameters) {
    if (!each.is_variable) remote.parameters.push_back(each);
  }
  current_->remotes.push_back(&remote);
}

}  // namespace runnel::genom
