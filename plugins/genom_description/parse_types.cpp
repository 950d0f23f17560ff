
#include "plugins/genom_description/component.h"
#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

constexpr std::size_t kMostDimensions = 32;

bool IsConstructed(const Token& word) { return word.IsWord("struct") || word.IsWord("union") || word.IsWord("enum"); }

}  // namespace

// Whether the next tokens declare a type, constant or exception, which has then been read.
bool Parser::TypeStatement() {
  if (reader_.IsWord("const")) {
    ConstantDeclaration();
  } else if (reader_.IsWord("typedef")) {
    TypedefDeclaration();
  } else if (reader_.IsWord("native")) {
    NativeDeclaration();
  } else if (reader_.IsWord("exception")) {
    ExceptionDeclaration();
  } else if (IsConstructed(reader_.Peek())) {
    (void)ConstructedType();
    reader_.Semicolon();
  } else {
    return false;
  }
  return true;
}

void Parser::ConstantDeclaration() {
  const Token begin = reader_.Take();
  const Token& next = reader_.Peek();
  if (IsConstructed(next) || next.IsWord("sequence") || next.IsWord("optional") || next.IsWord("any")) {
    reader_.Fail("the type of a constant: a number, boolean, char, string, or the name of a type");
  }
  Type* type = SimpleType();
  const Token name = reader_.Identifier("a constant");
  reader_.ExpectMark("=");
  const Constant value = Expression();
  reader_.Semicolon();
  const auto fitting = type == nullptr ? std::nullopt : Cast(value, type, begin.place, problems_);
  if (!fitting) {
    scopes_.DeclareInvalid(name.text, name.place);
    return;
  }
  Type* constant = scopes_.Declare(TypeKind::kConstant, name.text, name.place);
  if (constant == nullptr) return;
  constant->type = type;
  constant->value = *fitting;
}

void Parser::TypedefDeclaration() {
  reader_.Take();
  // An alias may be made of what is only announced.
  Type* type = IsConstructed(reader_.Peek()) ? TypeSpecification() : SimpleType(true);
  do {
    const Declarator declarator = ReadDeclarator("a type");
    if (type == nullptr) {
      scopes_.DeclareInvalid(declarator.name.text, declarator.name.place);
      continue;
    }
    Type* alias = scopes_.Declare(TypeKind::kTypedef, declarator.name.text, declarator.name.place);
    if (alias != nullptr) alias->type = WithSizes(type, declarator);
  } while (reader_.AcceptMark(","));
  reader_.Semicolon();
}

void Parser::NativeDeclaration() {
  reader_.Take();
  const Token name = reader_.Identifier("a native type");
  reader_.Semicolon();
  (void)scopes_.Declare(TypeKind::kNative, name.text, name.place);
}

void Parser::ExceptionDeclaration() {
  reader_.Take();
  do {
    const Token name = reader_.Identifier("an exception");
    Scope* scope = scopes_.EnterMembers(name.text, name.place, TypeKind::kException);
    std::vector<Type*> members;
    if (reader_.IsMark("{")) {
      reader_.Take();
      while (!reader_.IsMark("}")) Member(&members);
      reader_.Take();
    }
    (void)Finished(scope, TypeKind::kException, name, std::move(members), nullptr);
  } while (reader_.AcceptMark(","));
  reader_.Semicolon();
}

// Leaves the scope of the members, and declares what they belong to.
Type* Parser::Finished(Scope* scope, TypeKind kind, const Token& name, std::vector<Type*> members, Type* switch_type) {
  scopes_.Enter(scope->parent);
  if (scope->name.starts_with('&')) return nullptr;
  Type* type = scopes_.Declare(kind, name.text, name.place);
  if (type == nullptr) return nullptr;
  type->scope = scope;
  type->members = std::move(members);
  type->type = switch_type;
  return type;
}

Parser::Declarator Parser::ReadDeclarator(std::string_view of) {
  Declarator declarator{.name = reader_.Identifier(of), .sizes = {}};
  while (reader_.AcceptMark("[")) {
    declarator.sizes.push_back(Size());
    reader_.ExpectMark("]");
    if (declarator.sizes.size() > kMostDimensions) reader_.Fail("an array of fewer dimensions");
  }
  return declarator;
}

// "long a[2][3]" is an array of two arrays of three.
Type* Parser::WithSizes(Type* type, const Declarator& declarator) {
  for (auto size = declarator.sizes.rbegin(); size != declarator.sizes.rend(); ++size) {
    type = scopes_.Make(TypeKind::kArray, declarator.name.place, type);
    type->length = *size;
  }
  return type;
}

Type* Parser::TypeSpecification() {
  const TokenReader::Depth depth(reader_);
  return IsConstructed(reader_.Peek()) ? ConstructedType() : SimpleType();
}

Type* Parser::ConstructedType() {
  if (reader_.IsWord("struct")) return Struct();
  return reader_.IsWord("union") ? Union() : Enum();
}

Type* Parser::SimpleType(bool may_be_forward) {
  const TokenReader::Depth depth(reader_);
  const Token begin = reader_.Peek();
  if (begin.IsWord("sequence")) return Sequence();
  if (begin.IsWord("optional")) return Optional();
  if (begin.IsWord("string")) return String();
  if (begin.IsWord("fixed")) {
    reader_.Fail("a type that exists here", "numbers of fixed point are not supported; take double");
  }
  if (Type* base = BaseType(); base != nullptr) return base;
  if (begin.IsWord("any")) {
    problems_.Add(reader_.Take().place, "'any' is supported by nothing that is made from descriptions",
                  "name the type, or make it a union");
    return nullptr;
  }
  if (!reader_.IsIdentifier() && !reader_.IsMark("::")) {
    reader_.Fail("a type", IsConstructed(begin) ? "declare it before, and name it here" : "");
  }
  Type* type = NamedType();
  if (type != nullptr && type->Is(TypeKind::kException) && type->members.empty()) {
    problems_.Add(begin.place, "exception '" + type->name + "' has no members, so it is no type");
    return nullptr;
  }
  if (type == nullptr || may_be_forward) return type;
  if ((type->Is(TypeKind::kForwardStruct) || type->Is(TypeKind::kForwardUnion)) && type->type == nullptr) {
    problems_.Add(begin.place, KindAndName(*type) + " is only announced yet",
                  "until it is defined, it can be held by sequences and optionals");
    return nullptr;
  }
  return type;
}

Type* Parser::BaseType() {
  const Token word = reader_.Peek();
  if (word.kind != Token::Kind::kWord) return nullptr;
  const auto make = [&](TypeKind kind) {
    reader_.Take();
    return scopes_.Make(kind, word.place);
  };
  if (word.text == "boolean") return make(TypeKind::kBoolean);
  if (word.text == "octet") return make(TypeKind::kOctet);
  if (word.text == "char") return make(TypeKind::kCharacter);
  if (word.text == "float") return make(TypeKind::kFloat);
  if (word.text == "double") return make(TypeKind::kDouble);
  const bool is_unsigned = reader_.AcceptWord("unsigned");
  if (reader_.IsWord("short")) return make(is_unsigned ? TypeKind::kUnsignedShort : TypeKind::kShort);
  if (reader_.IsWord("long")) {
    Type* type = make(is_unsigned ? TypeKind::kUnsignedLong : TypeKind::kLong);
    if (reader_.AcceptWord("long")) {
      type->kind = is_unsigned ? TypeKind::kUnsignedLongLong : TypeKind::kLongLong;
    }
    return type;
  }
  if (is_unsigned) reader_.Fail("'short' or 'long' behind 'unsigned'");
  return nullptr;
}

Type* Parser::Sequence() {
  const Token begin = reader_.Take();
  if (reader_.IsMark("[")) reader_.Fail("'<'", "\"<:\" is another way to write '[': put a blank between < and ::");
  reader_.ExpectMark("<");
  ++angles_;
  Type* of = SimpleType(true);
  std::uint64_t length = Type::kUnbounded;
  if (reader_.AcceptMark(",")) length = Size();
  --angles_;
  reader_.ExpectClosingAngle();
  if (of == nullptr) return nullptr;
  Type* type = scopes_.Make(TypeKind::kSequence, begin.place, of);
  type->length = length;
  return type;
}

Type* Parser::Optional() {
  const Token begin = reader_.Take();
  reader_.ExpectMark("<");
  ++angles_;
  Type* of = SimpleType(true);
  --angles_;
  reader_.ExpectClosingAngle();
  return of == nullptr ? nullptr : scopes_.Make(TypeKind::kOptional, begin.place, of);
}

Type* Parser::String() {
  Type* type = scopes_.Make(TypeKind::kString, reader_.Take().place);
  if (reader_.AcceptMark("<")) {
    ++angles_;
    type->length = Size();
    --angles_;
    reader_.ExpectClosingAngle();
  }
  return type;
}

std::string Parser::ScopedName() {
  std::string name;
  if (reader_.AcceptMark("::")) name = "::";
  name += reader_.Identifier("a type").text;
  while (reader_.AcceptMark("::")) name += "::" + reader_.Identifier("a type").text;
  return name;
}

Type* Parser::NamedType() {
  const Place place = reader_.Peek().place;
  const std::string name = ScopedName();
  Type* type = scopes_.Find(name);
  if (type == nullptr) {
    scopes_.TellUnknown(name, place);
    return nullptr;
  }
  if (type->Is(TypeKind::kEvent) || type->Is(TypeKind::kPauseEvent) || type->Is(TypeKind::kPort) ||
      type->Is(TypeKind::kRemote)) {
    problems_.Add(place, KindAndName(*type) + " is no type", problems_.DeclaredAt(type->place));
    return nullptr;
  }
  return type;
}

void Parser::Members(std::vector<Type*>* members) {
  reader_.ExpectMark("{");
  do {
    Member(members);
  } while (!reader_.IsMark("}"));
  reader_.Take();
}

// One or more members of a type; nullptr: of the ids.
void Parser::Member(std::vector<Type*>* members) {
  Scope* scope = scopes_.current();
  Type* type = TypeSpecification();
  do {
    const Declarator declarator = ReadDeclarator("a member");
    if (type == nullptr) {
      scopes_.DeclareInvalid(declarator.name.text, declarator.name.place);
      continue;
    }
    Type* of = WithSizes(type, declarator);
    if (members == nullptr) {
      rules_.AddIdsMember(declarator.name, of);
      continue;
    }
    Type* member = scopes_.Declare(TypeKind::kMember, declarator.name.text, declarator.name.place);
    if (member == nullptr) continue;
    member->type = of;
    members->push_back(member);
  } while (reader_.AcceptMark(","));
  reader_.Semicolon();
  scopes_.Enter(scope);
}

Type* Parser::Struct() {
  const Token begin = reader_.Take();
  const Token name = reader_.Identifier("a struct");
  if (reader_.IsMark(";")) return scopes_.Declare(TypeKind::kForwardStruct, name.text, begin.place);
  Scope* scope = scopes_.EnterMembers(name.text, name.place, TypeKind::kStruct);
  std::vector<Type*> members;
  Members(&members);
  return Finished(scope, TypeKind::kStruct, name, std::move(members), nullptr);
}

Type* Parser::Enum() {
  reader_.Take();
  const Token name = reader_.Identifier("an enum");
  reader_.ExpectMark("{");
  std::vector<Type*> enumerators;
  do {
    const Token each = reader_.Identifier("an enumerator");
    Type* enumerator = scopes_.Declare(TypeKind::kEnumerator, each.text, each.place);
    if (enumerator != nullptr) {
      enumerator->type = scopes_.Make(TypeKind::kInvalid, each.place);  // should the enum never be finished
      enumerators.push_back(enumerator);
    }
    if (reader_.IsMark("="))
      reader_.Fail("',' or '}'", "enumerators are numbered from 0, and have no values of their own");
  } while (reader_.AcceptMark(","));
  reader_.ExpectMark("}");
  Type* type = scopes_.Declare(TypeKind::kEnum, name.text, name.place);
  if (type == nullptr) type = scopes_.Make(TypeKind::kInvalid, name.place);
  for (Type* each : enumerators) each->type = type;
  type->members = std::move(enumerators);
  return type;
}

}  // namespace runnel::genom
