#include <algorithm>

#include "plugins/genom_description/component.h"
#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

bool CanSwitch(TypeKind kind) {
  switch (kind) {
    case TypeKind::kInvalid:
    case TypeKind::kBoolean:
    case TypeKind::kCharacter:
    case TypeKind::kEnum:
    case TypeKind::kShort:
    case TypeKind::kUnsignedShort:
    case TypeKind::kLong:
    case TypeKind::kUnsignedLong:
    case TypeKind::kLongLong:
    case TypeKind::kUnsignedLongLong:
      return true;
    default:
      return false;
  }
}

}  // namespace

Type* Parser::SwitchType() {
  const Token begin = reader_.Peek();
  Type* type = nullptr;
  if (begin.IsWord("enum")) {
    type = Enum();
  } else if (begin.IsWord("float") || begin.IsWord("double") || begin.IsWord("octet") || begin.IsWord("string")) {
    reader_.Fail("a whole number, char, boolean or enum to switch by");
  } else {
    type = SimpleType();
  }
  if (type == nullptr || CanSwitch(FinalType(type)->kind)) return type;
  problems_.Add(begin.place,
                "a union is switched by a whole number, char, boolean or enum, not by " + KindAndName(*type));
  return nullptr;
}

Type* Parser::Union() {
  const Token begin = reader_.Take();
  const Token name = reader_.Identifier("a union");
  if (reader_.IsMark(";")) return scopes_.Declare(TypeKind::kForwardUnion, name.text, begin.place);
  Scope* scope = scopes_.EnterMembers(name.text, name.place, TypeKind::kUnion);
  if (!reader_.AcceptWord("switch")) reader_.Fail("'switch'");
  reader_.ExpectMark("(");
  Type* switch_type = SwitchType();
  reader_.ExpectMark(")");
  reader_.ExpectMark("{");
  std::vector<Type*> cases;
  do {
    UnionCase(cases);
  } while (!reader_.IsMark("}"));
  reader_.Take();
  if (switch_type == nullptr) {
    scopes_.Enter(scope->parent);
    scopes_.DeclareInvalid(name.text, name.place);
    return nullptr;
  }
  const auto same = scope->types.find(switch_type->name);
  if (!switch_type->name.empty() && same != scope->types.end()) {
    problems_.Add(same->second->place, KindAndName(*same->second) + " is called like what the union is switched by",
                  same->second == switch_type ? "declare the enum before the union" : "");
  }
  Type* type = Finished(scope, TypeKind::kUnion, name, std::move(cases), switch_type);
  if (type != nullptr) CheckLabels(*type);
  return type;
}

void Parser::CheckLabels(Type& new_union) {
  for (Type* each : new_union.members) {
    for (Constant& label : each->labels) {
      if (label.kind == Constant::Kind::kNone) continue;
      if (const auto fitting = Cast(label, new_union.type, each->place, problems_)) label = *fitting;
    }
  }
}

// "case VALUE:" or "default:"; false: there is none here.
bool Parser::CaseLabel(std::vector<Constant>& labels) {
  const Place place = reader_.Peek().place;
  Constant label;
  if (reader_.AcceptWord("case")) {
    label = Expression();
  } else if (!reader_.AcceptWord("default")) {
    return false;
  }
  reader_.ExpectMark(":");
  if (std::ranges::any_of(labels, [&](const Constant& each) { return AreEqual(each, label); })) {
    problems_.Warn(place, "this label stands here twice");
    return true;
  }
  labels.push_back(label);
  return true;
}

void Parser::UnionCase(std::vector<Type*>& cases) {
  std::vector<Constant> labels;
  const Place place = reader_.Peek().place;
  while (CaseLabel(labels)) {
  }
  if (labels.empty()) reader_.Fail("'case' or 'default'");
  Type* type = TypeSpecification();
  const Declarator declarator = ReadDeclarator("a member of the union");
  reader_.Semicolon();
  for (const Type* before : cases) {
    for (const Constant& label : labels) {
      const auto same =
          std::ranges::find_if(before->labels, [&](const Constant& each) { return AreEqual(each, label); });
      if (same == before->labels.end()) continue;
      problems_.Add(place,
                    label.kind == Constant::Kind::kNone ? "this union has a default already"
                                                        : "this union has a case " + label.ToText() + " already",
                    problems_.DeclaredAt(before->place));
    }
  }
  if (type == nullptr) {
    scopes_.DeclareInvalid(declarator.name.text, declarator.name.place);
    return;
  }
  Type* member = scopes_.Declare(TypeKind::kCase, declarator.name.text, declarator.name.place);
  if (member == nullptr) return;
  member->type = WithSizes(type, declarator);
  member->labels = std::move(labels);
  cases.push_back(member);
}

}  // namespace runnel::genom
