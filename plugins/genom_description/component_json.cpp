#include "plugins/genom_description/component_json.h"

#include <algorithm>
#include <cmath>

#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

namespace {

// What `make` makes of each.
template <typename List, typename Make>
Json ListOf(const List& list, const Make& make) {
  Json json = Json::array();
  for (const auto& each : list) json.push_back(make(each));
  return json;
}

// null: there is none.
constexpr auto kNameOf = [](const auto* named) { return named == nullptr ? Json(nullptr) : Json(named->name); };

Json Texts(const Properties& properties, PropertyKind kind) {
  const Property* found = Find(properties, kind);
  return found == nullptr ? Json::array() : Json(found->texts);
}

// The services that one interrupts, or is before or after.
Json Named(PropertyKind relation, const Service& service) {
  Json names = Json::array();
  for (const Service* each : service.component->services) {
    if (Names(relation, service, *each)) names.push_back(each->name);
  }
  return names;
}

Json Interfaces(const Properties& properties, PropertyKind kind) {
  const Property* found = Find(properties, kind);
  return found == nullptr ? Json::array() : ListOf(found->interfaces, kNameOf);
}

Json Number(const Properties& properties, PropertyKind kind) {
  const Property* found = Find(properties, kind);
  return found == nullptr ? Json(nullptr) : Json(found->number);
}

Json EventNames(const std::vector<Type*>& events) {
  return ListOf(events,
                [](const Type* each) { return (each->Is(TypeKind::kPauseEvent) ? "pause::" : "") + each->name; });
}

}  // namespace

Json JsonWriter::PlaceJson(Place place) const {
  if (place.file < 0) return nullptr;
  return {{"file", problems_.FileName(place.file)}, {"line", place.line}, {"column", place.column}};
}

bool JsonWriter::IsDeclared(const Type& type) {
  if (type.name.empty() || type.full_name.empty()) return false;
  switch (type.kind) {
    case TypeKind::kEnum:
    case TypeKind::kStruct:
    case TypeKind::kUnion:
    case TypeKind::kException:
    case TypeKind::kTypedef:
    case TypeKind::kConstant:
    case TypeKind::kNative:
      return true;
    default:
      return false;
  }
}

Json JsonWriter::ConstantJson(const Constant& value) const {
  switch (value.kind) {
    case Constant::Kind::kBoolean:
      return value.boolean;
    case Constant::Kind::kUnsigned:
      return value.whole;
    case Constant::Kind::kSigned:
      return static_cast<std::int64_t>(value.whole);
    case Constant::Kind::kReal:
      if (!std::isfinite(value.real)) return value.ToText();  // JSON has no such number
      return value.real;
    case Constant::Kind::kString:
    case Constant::Kind::kCharacter:
      return value.text;
    case Constant::Kind::kEnumerator:
      return value.ToText();
    case Constant::Kind::kNone:
      break;
  }
  return nullptr;
}

// A named type by its name, another by what it is made of.
Json JsonWriter::Reference(const Type* type) const {
  // A member that has the name of a type hides it, and stands for its own.
  while ((type->Is(TypeKind::kForwardStruct) || type->Is(TypeKind::kForwardUnion) || type->Is(TypeKind::kMember)) &&
         type->type != nullptr) {
    type = type->type;
  }
  Json json{{"kind", NameOf(type->kind)}};
  if (!type->full_name.empty()) json["name"] = type->ShownName();
  if (type->full_name.empty()) {
    if (type->length != Type::kUnbounded) json["length"] = type->length;
    if (type->type != nullptr) json["type"] = Reference(type->type);
  }
  return json;
}

Json JsonWriter::Members(const Type& type) const {
  std::vector<std::uint64_t> offsets;
  if (!type.Is(TypeKind::kUnion)) (void)layouts_.OfMembers(type.members, &offsets);
  Json members = Json::array();
  for (std::size_t i = 0; i < type.members.size(); ++i) {
    const Type& each = *type.members[i];
    Json member{{"name", each.name}, {"type", Reference(each.type)}};
    if (!type.Is(TypeKind::kUnion)) member["offset"] = offsets[i];
    if (type.Is(TypeKind::kUnion)) {
      member["labels"] = Json::array();
      member["is_default"] = false;
      for (const Constant& label : each.labels) {
        if (label.kind == Constant::Kind::kNone)
          member["is_default"] = true;
        else
          member["labels"].push_back(ConstantJson(label));
      }
    }
    members.push_back(std::move(member));
  }
  return members;
}

Json JsonWriter::Declared(const Type& type) const {
  Json json{{"kind", NameOf(type.kind)}, {"name", type.ShownName()}, {"place", PlaceJson(type.place)}};
  if (type.kind == TypeKind::kConstant) {
    json["type"] = Reference(type.type);
    json["value"] = ConstantJson(type.value);
    return json;
  }
  const Layout layout = layouts_.Of(type);
  json["size"] = layout.size;
  json["alignment"] = layout.alignment;
  if (type.Is(TypeKind::kTypedef)) json["type"] = Reference(type.type);
  if (type.Is(TypeKind::kUnion)) json["switch"] = Reference(type.type);
  if (type.Is(TypeKind::kEnum)) {
    json["enumerators"] = ListOf(type.members, [](const Type* each) { return each->ShownName(); });
  } else if (type.Is(TypeKind::kStruct) || type.Is(TypeKind::kUnion) || type.Is(TypeKind::kException)) {
    json["members"] = Members(type);
  }
  return json;
}

Json JsonWriter::InitialJson(const Initializer& initial) const {
  Json json = Json::object();
  if (!initial.member.empty()) json["member"] = initial.member;
  if (initial.index) json["index"] = *initial.index;
  if (initial.has_doc) json["doc"] = initial.doc;
  if (initial.is_compound) {
    json["parts"] = ListOf(initial.parts, [this](const Initializer& each) { return InitialJson(each); });
  } else if (initial.value.kind != Constant::Kind::kNone) {
    json["value"] = ConstantJson(initial.value);
  }
  return json;
}

Json JsonWriter::ParameterJson(const Parameter& parameter) const {
  Json json{{"name", parameter.name}, {"direction", NameOf(parameter.direction)}, {"source", NameOf(parameter.source)}};
  if (parameter.is_variable) json.erase("direction");
  json["place"] = PlaceJson(parameter.place);
  json["path"] = ListOf(
      parameter.path, [](const PathStep& each) { return each.member.empty() ? Json(each.index) : Json(each.member); });
  if (parameter.port != nullptr) {
    json["port"] = parameter.port->name;
    json["type"] = Reference(parameter.port->type);
  } else if (parameter.remote != nullptr) {
    json["remote"] = parameter.remote->name;
  } else {
    json["type"] = Reference(parameter.type);
  }
  if (parameter.initial) json["default"] = InitialJson(*parameter.initial);
  return json;
}

Json JsonWriter::Parameters(const std::vector<Parameter>& parameters, bool are_variables) const {
  Json json = Json::array();
  for (const Parameter& each : parameters) {
    if (each.is_variable == are_variables) json.push_back(ParameterJson(each));
  }
  return json;
}

Json JsonWriter::Exceptions(std::initializer_list<const Properties*> all) const {
  Json names = Json::array();
  for (const Properties* properties : all) {
    const Property* found = Find(*properties, PropertyKind::kThrow);
    if (found == nullptr) continue;
    for (const Type* each : found->exceptions) {
      const Json name = each->ShownName();
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

Json JsonWriter::TaskJson(const Task& task) const {
  Json json{
      {"name", task.name}, {"place", PlaceJson(task.place)}, {"doc", TextOf(task.properties, PropertyKind::kDoc)}};
  json["period"] = Number(task.properties, PropertyKind::kPeriod);
  json["delay"] = Number(task.properties, PropertyKind::kDelay);
  json["priority"] = Number(task.properties, PropertyKind::kPriority);
  json["stack"] = Number(task.properties, PropertyKind::kStack);
  json["is_real_time"] = Find(task.properties, PropertyKind::kScheduling) != nullptr;
  json["throws"] = Exceptions({&task.properties, &task.component->properties});
  json["states"] = Json::object();
  for (const auto& [state, codel] : task.states) json["states"][state] = codel->name;
  json["codels"] = ListOf(CodelsOf(task.properties), [this](const Codel* each) { return CodelJson(*each); });
  return json;
}

Json JsonWriter::PortJson(const Port& port) const {
  return {{"name", port.name},
          {"place", PlaceJson(port.place)},
          {"doc", port.doc},
          {"interface", port.interface},
          {"direction", port.is_input ? "in" : "out"},
          {"is_multiple", port.is_multiple},
          {"type", Reference(port.type)}};
}

Json JsonWriter::ServiceJson(const Service& service) const {
  Json json{{"name", service.name},
            {"kind", NameOf(service.kind)},
            {"place", PlaceJson(service.place)},
            {"doc", TextOf(service.properties, PropertyKind::kDoc)}};
  const Task* task = service.task();
  json["task"] = kNameOf(task);
  json["parameters"] = Parameters(service.parameters, false);
  json["variables"] = Parameters(service.parameters, true);
  json["throws"] = task == nullptr
                       ? Exceptions({&service.properties, &service.component->properties})
                       : Exceptions({&service.properties, &task->properties, &service.component->properties});
  json["interrupts"] = Named(PropertyKind::kInterrupts, service);
  json["before"] = Named(PropertyKind::kBefore, service);
  json["after"] = Named(PropertyKind::kAfter, service);
  json["states"] = Json::object();
  for (const auto& [state, codel] : service.states) json["states"][state] = codel->name;
  json["codels"] = ListOf(CodelsOf(service.properties), [this](const Codel* each) { return CodelJson(*each); });
  json["excludes_codels"] = ListOf(ConflictingCodels(service), kNameOf);
  return json;
}

Json JsonWriter::CodelJson(const Codel& codel) const {
  Json json{{"name", codel.name},
            {"kind", NameOf(codel.kind)},
            {"place", PlaceJson(codel.place)},
            {"is_async", codel.is_async}};
  json["task"] = kNameOf(codel.task);
  json["parameters"] = Parameters(codel.parameters, false);
  json["states"] = EventNames(codel.triggers);
  json["yields"] = EventNames(codel.yields);
  json["excludes_codels"] = ListOf(ConflictingCodels(codel), [](const Codel* each) {
    return Json{{"codel", each->name}, {"task", kNameOf(each->task)}, {"service", kNameOf(each->service)}};
  });
  json["excludes_services"] = ListOf(ConflictingServices(codel), kNameOf);
  return json;
}

Json JsonWriter::ComponentJson(const Component& component) const {
  const Properties& properties = component.properties;
  Json json{{"name", component.name},
            {"place", PlaceJson(component.place)},
            {"doc", TextOf(properties, PropertyKind::kDoc)},
            {"version", TextOf(properties, PropertyKind::kVersion, "0")},
            {"lang", TextOf(properties, PropertyKind::kLanguage, "c")},
            {"email", TextOf(properties, PropertyKind::kEmail)},
            {"require", Texts(properties, PropertyKind::kRequire)},
            {"codels_require", Texts(properties, PropertyKind::kCodelsRequire)}};
  json["clock_rate"] = component.clock_rate;
  json["provides"] = Interfaces(properties, PropertyKind::kProvides);
  json["uses"] = Interfaces(properties, PropertyKind::kUses);
  json["extends"] = Interfaces(properties, PropertyKind::kExtends);
  json["throws"] = Exceptions({&properties});
  json["ids"] = component.ids == nullptr ? Json(nullptr) : Declared(*component.ids);
  json["tasks"] = ListOf(component.tasks, [this](const Task* each) { return TaskJson(*each); });
  json["ports"] = ListOf(component.ports, [this](const Port* each) { return PortJson(*each); });
  json["services"] = ListOf(component.services, [this](const Service* each) { return ServiceJson(*each); });
  json["remotes"] = ListOf(component.remotes, [this](const Remote* each) {
    return Json{{"name", each->name},
                {"kind", NameOf(each->kind)},
                {"place", PlaceJson(each->place)},
                {"parameters", Parameters(each->parameters, false)}};
  });
  json["digest"] = DigestOf(component);
  return json;
}

}  // namespace runnel::genom
