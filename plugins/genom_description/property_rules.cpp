#include <algorithm>
#include <array>

#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

namespace {

using Kind = PropertyKind;
using Owner = PropertyOwner;

constexpr std::array<std::string_view, 7> kOwners = {"components", "interfaces", "ports",     "tasks",
                                                     "attributes", "functions",  "activities"};

bool IsAllowed(const Property& property, Owner owner) {
  const bool is_service = owner == Owner::kAttribute || owner == Owner::kFunction || owner == Owner::kActivity;
  switch (property.kind) {
    case Kind::kDoc:
      return true;
    case Kind::kVersion:
    case Kind::kLanguage:
    case Kind::kEmail:
    case Kind::kRequire:
    case Kind::kCodelsRequire:
    case Kind::kClockRate:
    case Kind::kProvides:
    case Kind::kUses:
    case Kind::kExtends:
      return owner == Owner::kComponent || owner == Owner::kInterface;
    case Kind::kThrow:
      return owner != Owner::kPort;
    case Kind::kPeriod:
    case Kind::kDelay:
    case Kind::kPriority:
    case Kind::kScheduling:
      return owner == Owner::kTask;
    case Kind::kStack:
      return owner == Owner::kTask || owner == Owner::kComponent || owner == Owner::kInterface;
    case Kind::kTask:
      return owner == Owner::kActivity;
    case Kind::kInterrupts:
    case Kind::kBefore:
    case Kind::kAfter:
      return is_service;
    case Kind::kCodel:
      switch (property.codel->kind) {
        case CodelKind::kValidate:
          return is_service;
        case CodelKind::kSimple:
          return owner == Owner::kAttribute || owner == Owner::kFunction;
        case CodelKind::kStateMachine:
          return owner == Owner::kActivity || owner == Owner::kTask;
      }
  }
  return false;
}

std::string WhatIsSaid(const Property& property) {
  if (property.kind != Kind::kCodel) return "'" + std::string(NameOf(property.kind)) + "'";
  return "a " + std::string(NameOf(property.codel->kind)) + " codel";
}

std::string Cure(const Property& property, Owner owner) {
  if (property.kind == Kind::kTask) return "they run in the control task";
  if (property.kind == Kind::kCodel && property.codel->kind == CodelKind::kSimple) {
    return "say in which state it runs: codel<start> NAME() yield ether";
  }
  if (property.kind == Kind::kCodel && property.codel->kind == CodelKind::kStateMachine && owner == Owner::kFunction) {
    return "make it an activity, or a codel without states";
  }
  return "";
}

template <typename Thing>
void AddNew(std::vector<Thing>& into, const std::vector<Thing>& from) {
  for (const Thing& each : from) {
    if (std::ranges::find(into, each) == into.end()) into.push_back(each);
  }
}

bool TellRepeated(const Property& property, const Property& before, Problems& problems) {
  const std::string what =
      property.kind == Kind::kCodel ? "codel '" + property.codel->name + "'" : WhatIsSaid(property);
  problems.Add(property.place, what + " is declared twice", problems.DeclaredAt(before.place));
  return false;
}

// What adds up, or of which the first holds; false where it may not be said again.
bool Merge(Property& into, const Property& from, Problems& problems) {
  switch (into.kind) {
    case Kind::kDoc:
      into.text += "\n" + from.text;
      return true;
    case Kind::kRequire:
    case Kind::kCodelsRequire:
      AddNew(into.texts, from.texts);
      return true;
    case Kind::kInterrupts:
      into.texts.insert(into.texts.end(), from.texts.begin(), from.texts.end());
      into.places.insert(into.places.end(), from.places.begin(), from.places.end());
      return true;
    case Kind::kThrow:
      AddNew(into.exceptions, from.exceptions);
      return true;
    case Kind::kProvides:
    case Kind::kUses:
    case Kind::kExtends:
      AddNew(into.interfaces, from.interfaces);
      return true;
    case Kind::kVersion:
    case Kind::kEmail:
    case Kind::kTask:
      if (into.text != from.text || into.task != from.task) {
        problems.Warn(from.place, WhatIsSaid(from) + " has been said before, which holds",
                      problems.DeclaredAt(into.place));
      }
      return true;
    case Kind::kLanguage:
      return into.text == from.text || TellRepeated(from, into, problems);
    default:
      return TellRepeated(from, into, problems);
  }
}

}  // namespace

Owner OwnerOf(ServiceKind kind) {
  return kind == ServiceKind::kAttribute  ? Owner::kAttribute
         : kind == ServiceKind::kFunction ? Owner::kFunction
                                          : Owner::kActivity;
}

bool AddProperty(Properties& properties, Property property, Owner owner, Problems& problems) {
  if (!IsAllowed(property, owner)) {
    problems.Add(property.place,
                 WhatIsSaid(property) + " is nothing for " + std::string(kOwners.at(static_cast<std::size_t>(owner))),
                 Cure(property, owner));
    return false;
  }
  const auto before = std::ranges::find_if(properties, [&](const Property& each) {
    return each.kind == property.kind && (each.kind != Kind::kCodel || each.codel->name == property.codel->name);
  });
  if (before != properties.end()) return Merge(*before, property, problems);
  properties.push_back(std::move(property));
  return true;
}

}  // namespace runnel::genom
