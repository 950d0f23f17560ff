#include <cmath>

#include "plugins/genom_description/component_json.h"

namespace runnel::genom {

Json JsonWriter::PlaceJson(Place place) const {
  if (place.file < 0) return nullptr;
  return {{"file", problems_.FileName(place.file)}, {"line", place.line}, {"column", place.column}};
}

bool JsonWriter::IsDeclared(const Type& type) {
  if (type.name.empty() || type.full_name.empty()) return false;
  switch (type.kind) {
    case TypeKind::kEnum: case TypeKind::kStruct: case TypeKind::kUnion: case TypeKind::kException:
    case TypeKind::kTypedef: case TypeKind::kConstant: case TypeKind::kNative:
      return true;
    default:
      return false;
  }
}

Json JsonWriter::ConstantJson(const Constant& value) const {
  switch (value.kind) {
    case Constant::Kind::kBoolean: return value.boolean;
    case Constant::Kind::kUnsigned: return value.whole;
    case Constant::Kind::kSigned: return static_cast<std::int64_t>(value.whole);
    case Constant::Kind::kReal:
      if (!std::isfinite(value.real)) return value.ToText();  // JSON has no such number
      return value.real;
    case Constant::Kind::kString: case Constant::Kind::kCharacter: return value.text;
    case Constant::Kind::kEnumerator: return value.ToText();
    case Constant::Kind::kNone: break;
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
        if (label.kind == Constant::Kind::kNone) member["is_default"] = true;
        else member["labels"].push_back(ConstantJson(label));
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
    json["enumerators"] = Json::array();
    for (const Type* each : type.members) json["enumerators"].push_back(each->ShownName());
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
    json["parts"] = Json::array();
    for (const Initializer& each : initial.parts) json["parts"].push_back(InitialJson(each));
  } else if (initial.value.kind != Constant::Kind::kNone) {
    json["value"] = ConstantJson(initial.value);
  }
  return json;
}

}  // namespace runnel::genom
