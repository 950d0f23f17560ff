#include <cmath>
#include <limits>

#include "core/base/nearest_name.h"
#include "plugins/genom_description/component.h"

namespace runnel::genom {

namespace {

using Kind = Constant::Kind;

// kNone: nothing can be a constant of that type.
Kind KindFor(TypeKind type) {
  switch (type) {
    case TypeKind::kBoolean:
      return Kind::kBoolean;
    case TypeKind::kOctet:
    case TypeKind::kUnsignedShort:
    case TypeKind::kUnsignedLong:
    case TypeKind::kUnsignedLongLong:
      return Kind::kUnsigned;
    case TypeKind::kShort:
    case TypeKind::kLong:
    case TypeKind::kLongLong:
      return Kind::kSigned;
    case TypeKind::kFloat:
    case TypeKind::kDouble:
      return Kind::kReal;
    case TypeKind::kCharacter:
    case TypeKind::kString:
      return Kind::kString;
    case TypeKind::kEnum:
      return Kind::kEnumerator;
    default:
      return Kind::kNone;
  }
}

void WarnOfRange(const Constant& value, const Type& type, Place place, Problems& problems) {
  std::int64_t lowest = 0;
  std::int64_t highest = 0;
  switch (type.kind) {
    case TypeKind::kOctet:
      highest = 255;
      break;
    case TypeKind::kUnsignedShort:
      highest = 65535;
      break;
    case TypeKind::kShort:
      lowest = -32768, highest = 32767;
      break;
    case TypeKind::kUnsignedLong:
      highest = 4294967295;
      break;
    case TypeKind::kLong:
      lowest = -2147483648LL, highest = 2147483647;
      break;
    case TypeKind::kLongLong:
      lowest = std::numeric_limits<std::int64_t>::min(), highest = std::numeric_limits<std::int64_t>::max();
      break;
    case TypeKind::kFloat:
      if (std::abs(value.real) > std::numeric_limits<float>::max()) {
        problems.Warn(place, value.ToText() + " is out of the range of " + type.ShownName());
      }
      return;
    case TypeKind::kString:
      if (type.length != Type::kUnbounded && value.text.size() > type.length) {
        problems.Warn(place, "this text is longer than " + type.ShownName() + " holds");
      }
      return;
    default:
      return;
  }
  const auto whole = static_cast<std::int64_t>(value.whole);
  const bool is_huge = value.kind == Kind::kUnsigned && whole < 0;
  if (is_huge || whole < lowest || whole > highest) {
    problems.Warn(place, value.ToText() + " is out of the range of " + type.ShownName());
  }
}

bool IsCompound(const Type& type) {
  return type.Is(TypeKind::kStruct) || type.Is(TypeKind::kUnion) || type.Is(TypeKind::kException);
}

bool CheckElements(Initializer& initial, const Type& array, Problems& problems) {
  std::uint64_t next = 0;
  for (Initializer& part : initial.parts) {
    if (!part.member.empty()) {
      problems.Add(part.place, array.ShownName() + " has no member '" + part.member + "'",
                   "elements are named by their index: [0] =");
      return false;
    }
    if (!part.index) part.index = next;
    if (*part.index >= array.length) {
      problems.Add(part.place, "element " + std::to_string(*part.index) + " is beyond the end of " + array.ShownName());
      return false;
    }
    next = *part.index + 1;
    if (!CheckInitializer(part, array.type, problems)) return false;
  }
  return true;
}

bool CheckMembers(Initializer& initial, const Type& compound, Problems& problems) {
  std::size_t next = 0;
  for (Initializer& part : initial.parts) {
    if (part.index) {
      problems.Add(part.place, KindAndName(compound) + " has no elements", "members are named so: .name =");
      return false;
    }
    if (!part.member.empty()) {
      const Type* member = MemberOf(const_cast<Type*>(&compound), part.member);
      if (member == nullptr) {
        problems.Add(part.place, KindAndName(compound) + " has no member '" + part.member + "'",
                     NearestNameHint(part.member, NamesOf(compound.members, &Type::name)));
        return false;
      }
      next = 0;
      while (compound.members[next] != member) ++next;
    }
    if (next >= compound.members.size()) {
      problems.Add(part.place, "these are more values than " + KindAndName(compound) + " has members");
      return false;
    }
    part.member = compound.members[next]->name;
    if (!CheckInitializer(part, compound.members[next]->type, problems)) return false;
    ++next;
  }
  return true;
}

}  // namespace

std::optional<Constant> Cast(const Constant& value, const Type* type, Place place, Problems& problems) {
  const Type& final_type = *FinalType(type);
  if (final_type.Is(TypeKind::kInvalid)) return value;
  const Kind kind = KindFor(final_type.kind);
  if (kind == Kind::kNone) {
    problems.Add(place, "there are no constants of " + KindAndName(*type), problems.DeclaredAt(type->place));
    return std::nullopt;
  }
  if (final_type.Is(TypeKind::kCharacter) && value.kind == Kind::kCharacter) {
    const bool is_escaped = value.text.starts_with('\\');
    if (value.text.size() == (is_escaped ? 2 : 1)) return value;
    problems.Add(place, "'" + value.text + "' is not one character");
    return std::nullopt;
  }
  const auto converted = Converted(value, kind);
  const bool is_other_enum =
      kind == Kind::kEnumerator && converted && FinalType(converted->enumerator->type) != &final_type;
  if (!converted || is_other_enum) {
    problems.Add(place, value.ToText() + " is no value of " + KindAndName(*type));
    return std::nullopt;
  }
  const bool is_whole = value.kind == Kind::kUnsigned || value.kind == Kind::kSigned;
  WarnOfRange(is_whole && kind != Kind::kReal ? value : *converted, final_type, place, problems);
  return converted;
}

bool CheckInitializer(Initializer& initial, Type* type, Problems& problems) {
  Type* final_type = FinalType(type);
  while (final_type->Is(TypeKind::kOptional)) final_type = FinalType(final_type->type);
  if (final_type->Is(TypeKind::kInvalid)) return true;
  const bool is_array = final_type->Is(TypeKind::kArray) || final_type->Is(TypeKind::kSequence);
  const bool is_compound = IsCompound(*final_type);
  if (initial.is_compound) {
    if (is_array) return CheckElements(initial, *final_type, problems);
    if (is_compound) return CheckMembers(initial, *final_type, problems);
    problems.Add(initial.place, KindAndName(*type) + " has no parts", "write its value without { }");
    return false;
  }
  if (initial.value.kind == Kind::kNone) return true;
  if (is_array || is_compound) {
    problems.Add(initial.place, initial.value.ToText() + " is no value of " + KindAndName(*type),
                 "write its parts in { }");
    return false;
  }
  const auto value = Cast(initial.value, final_type, initial.place, problems);
  if (value) initial.value = *value;
  return value.has_value();
}

}  // namespace runnel::genom
