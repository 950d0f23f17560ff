#include "plugins/genom_description/type.h"

#include <algorithm>
#include <array>
#include <set>

namespace runnel::genom {

namespace {

constexpr std::array<std::string_view, 32> kNames = {
    "unknown type",   "boolean",       "octet",         "char",      "short",
    "unsigned short", "long",          "unsigned long", "long long", "unsigned long long",
    "float",          "double",        "string",        "sequence",  "optional",
    "array",          "enum",          "enumerator",    "struct",    "union",
    "exception",      "member",        "union member",  "typedef",   "constant",
    "forward struct", "forward union", "native type",   "event",     "pause event",
    "port",           "remote"};

bool IsCompound(TypeKind kind) {
  return kind == TypeKind::kStruct || kind == TypeKind::kUnion || kind == TypeKind::kException;
}

bool IsElement(TypeKind kind) { return kind == TypeKind::kArray || kind == TypeKind::kSequence; }

// Depth first through all that a type is made of, each once.
template <typename Visit>
bool AnyWithin(const Type* type, bool through_pointers, std::set<const Type*>& seen, const Visit& visit) {
  std::vector<const Type*> open = {type};
  while (!open.empty()) {
    const Type* each = open.back();
    open.pop_back();
    if (each == nullptr) continue;
    each = FinalType(each);
    if (!seen.insert(each).second) continue;
    if (visit(each)) return true;
    if (IsCompound(each->kind)) {
      for (const Type* member : each->members) open.push_back(member->type);
    }
    const bool is_pointer = each->kind == TypeKind::kSequence && each->length == Type::kUnbounded;
    if (IsElement(each->kind) || each->kind == TypeKind::kOptional) {
      if (through_pointers || !is_pointer) open.push_back(each->type);
    }
  }
  return false;
}

}  // namespace

std::string_view NameOf(TypeKind kind) { return kNames.at(static_cast<std::size_t>(kind)); }

std::string Type::ShownName() const {
  if (!full_name.empty()) return full_name.substr(2);
  const std::string length_text = length == kUnbounded ? "" : std::to_string(length);
  switch (kind) {
    case TypeKind::kString:
      return length_text.empty() ? "string" : "string<" + length_text + ">";
    case TypeKind::kSequence:
      return "sequence<" + type->ShownName() + (length_text.empty() ? "" : ", " + length_text) + ">";
    case TypeKind::kOptional:
      return "optional<" + type->ShownName() + ">";
    case TypeKind::kArray:
      return type->ShownName() + "[" + length_text + "]";
    default:
      return std::string(NameOf(kind));
  }
}

std::string KindAndName(const Type& type) {
  if (type.name.empty()) return type.ShownName();
  return std::string(NameOf(type.kind)) + " " + type.ShownName();
}

Type* FinalType(Type* type) {
  while (true) {  // no type is made of itself but through a struct, where each of these loops ends
    switch (type->kind) {
      case TypeKind::kTypedef:
      case TypeKind::kMember:
      case TypeKind::kCase:
      case TypeKind::kConstant:
      case TypeKind::kForwardStruct:
      case TypeKind::kForwardUnion:
        if (type->type == nullptr) return type;
        type = type->type;
        break;
      default:
        return type;
    }
  }
}

const Type* FinalType(const Type* type) { return FinalType(const_cast<Type*>(type)); }

bool AreSame(const Type* a, const Type* b) {
  while (true) {  // no type is made of itself but through a struct, where each of these loops ends
    a = FinalType(a);
    b = FinalType(b);
    if (a == b) return true;
    if (a->kind == TypeKind::kInvalid || b->kind == TypeKind::kInvalid) return true;
    if (a->kind != b->kind) return false;
    if (a->kind == TypeKind::kString) return a->length == b->length;
    if (a->kind == TypeKind::kArray || a->kind == TypeKind::kSequence) {
      if (a->length != b->length) return false;
    } else if (a->kind != TypeKind::kOptional) {
      return a->full_name == b->full_name;  // of basic types both have none
    }
    a = a->type;
    b = b->type;
  }
}

Type* MemberOf(Type* type, std::string_view name) {
  type = FinalType(type);
  while (type->kind == TypeKind::kOptional) type = FinalType(type->type);
  if (!IsCompound(type->kind)) return nullptr;
  const auto found = std::ranges::find(type->members, name, &Type::name);
  return found == type->members.end() ? nullptr : *found;
}

Type* ElementOf(Type* type) {
  type = FinalType(type);
  while (type->kind == TypeKind::kOptional) type = FinalType(type->type);
  return IsElement(type->kind) ? type : nullptr;
}

bool Holds(const Type* type, TypeKind kind) {
  std::set<const Type*> seen;
  return AnyWithin(type, true, seen, [&](const Type* each) { return each->kind == kind; });
}

bool HoldsItself(const Type* type) {
  type = FinalType(type);
  if (!IsCompound(type->kind)) return false;
  std::set<const Type*> seen;
  for (const Type* member : type->members) {
    if (AnyWithin(member->type, false, seen, [&](const Type* each) { return each == type; })) return true;
  }
  return false;
}

}  // namespace runnel::genom
