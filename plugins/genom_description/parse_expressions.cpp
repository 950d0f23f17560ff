#include <array>

#include "plugins/genom_description/parser.h"

namespace runnel::genom {

namespace {

struct BinaryOperator {
  std::string_view mark;
  char operation;
  int binding;  // the higher, the tighter
};
constexpr std::array<BinaryOperator, 10> kOperators = {{{"|", '|', 1},
                                                        {"^", '^', 2},
                                                        {"&", '&', 3},
                                                        {"<<", '<', 4},
                                                        {">>", '>', 4},
                                                        {"+", '+', 5},
                                                        {"-", '-', 5},
                                                        {"*", '*', 6},
                                                        {"/", '/', 6},
                                                        {"%", '%', 6}}};

}  // namespace

Constant Parser::Expression() {
  const TokenReader::Depth depth(reader_);
  return BinaryExpression(1);
}

Constant Parser::BinaryExpression(int binding) {
  Constant left = UnaryExpression();
  while (true) {
    const Token mark = reader_.Peek();
    const BinaryOperator* found = nullptr;
    for (const BinaryOperator& each : kOperators) {
      if (mark.IsMark(each.mark) && each.binding >= binding) found = &each;
    }
    // Within two open '<', ">>" closes both.
    if (found == nullptr || (found->operation == '>' && angles_ > 1)) return left;
    reader_.Take();
    const Constant right = BinaryExpression(found->binding + 1);
    left = ValueOf(Compute(left, found->operation, right), mark.place);
  }
}

Constant Parser::ValueOf(Computed result, Place place) {
  if (result.error.empty()) return std::move(result.value);
  problems_.Add(place, result.error);
  return {.kind = Constant::Kind::kUnsigned, .whole = 1};
}

Constant Parser::UnaryExpression() {
  const Token mark = reader_.Peek();
  if (!mark.IsMark("-") && !mark.IsMark("+") && !mark.IsMark("~")) return PrimaryExpression();
  reader_.Take();
  return ValueOf(Compute(mark.text[0], PrimaryExpression()), mark.place);
}

Constant Parser::PrimaryExpression() {
  const Token token = reader_.Peek();
  switch (token.kind) {
    case Token::Kind::kInteger:
      reader_.Take();
      return {.kind = Constant::Kind::kUnsigned, .whole = token.integer};
    case Token::Kind::kReal:
      reader_.Take();
      return {.kind = Constant::Kind::kReal, .real = token.real};
    case Token::Kind::kFixed:
      problems_.Add(reader_.Take().place, "numbers of fixed point are not supported", "leave the d out");
      return {.kind = Constant::Kind::kReal, .real = token.real};
    case Token::Kind::kString:
      return {.kind = Constant::Kind::kString, .text = Text()};
    case Token::Kind::kCharacter:
      reader_.Take();
      return {.kind = Constant::Kind::kCharacter, .text = token.text};
    default:
      break;
  }
  if (token.IsWord("TRUE") || token.IsWord("FALSE")) {
    reader_.Take();
    return {.kind = Constant::Kind::kBoolean, .boolean = token.text == "TRUE"};
  }
  if (reader_.AcceptMark("(")) {
    const int angles = std::exchange(angles_, 0);
    Constant value = Expression();
    angles_ = angles;
    reader_.ExpectMark(")");
    return value;
  }
  if (reader_.IsIdentifier() || reader_.IsMark("::")) return NamedConstant();
  reader_.Fail("a value", token.IsMark("!") ? "there is no logic in expressions; ~ inverts a boolean" : "");
}

Constant Parser::NamedConstant() {
  const Place place = reader_.Peek().place;
  const std::string name = ScopedName();
  const Type* type = scopes_.Find(name);
  if (type == nullptr) {
    scopes_.TellUnknown(name, place);
  } else if (type->Is(TypeKind::kConstant)) {
    return type->value;
  } else if (type->Is(TypeKind::kEnumerator)) {
    return {.kind = Constant::Kind::kEnumerator, .enumerator = type};
  } else if (!type->Is(TypeKind::kInvalid)) {
    problems_.Add(place, KindAndName(*type) + " is no value", problems_.DeclaredAt(type->place));
  }
  return {.kind = Constant::Kind::kUnsigned, .whole = 0};
}

std::uint64_t Parser::Size() {
  const Place place = reader_.Peek().place;
  const Constant value = Expression();
  const auto size = Converted(value, Constant::Kind::kUnsigned);
  if (size) return size->whole;
  problems_.Add(place, value.ToText() + " is no whole number from 0 on");
  return 1;
}

// One string, or several that join.
std::string Parser::Text() {
  if (reader_.Peek().kind != Token::Kind::kString) reader_.Fail("a text in quotation marks");
  std::string text;
  while (reader_.Peek().kind == Token::Kind::kString) text += reader_.Take().text;
  return text;
}

std::vector<std::string> Parser::TextList(std::vector<Place>* places) {
  std::vector<std::string> texts;
  do {
    if (places != nullptr) places->push_back(reader_.Peek().place);
    texts.push_back(Text());
  } while (reader_.AcceptMark(","));
  return texts;
}

// What stands behind '=': a value, its documentation, or both.
Initializer Parser::ReadInitializer() {
  const TokenReader::Depth depth(reader_);
  Initializer initial{.place = reader_.Peek().place};
  if (!reader_.IsMark(":")) InitialValue(initial);
  if (reader_.AcceptMark(":")) {
    initial.doc = Text();
    initial.has_doc = true;
  }
  return initial;
}

void Parser::InitialValue(Initializer& initial) {
  if (reader_.IsMark("{")) {
    InitialParts(initial);
    return;
  }
  const bool is_element = reader_.AcceptMark("[");
  const bool is_member = !is_element && reader_.AcceptMark(".");
  if (is_element) {
    initial.index = Size();
    reader_.ExpectMark("]");
  } else if (is_member) {
    initial.member = reader_.Identifier("a member").text;
  } else {
    initial.value = Expression();
    return;
  }
  reader_.ExpectMark("=");
  if (reader_.IsMark("{")) {
    InitialParts(initial);
  } else if (!reader_.IsMark(",") && !reader_.IsMark("}") && !reader_.IsMark(":") && !reader_.IsMark(")")) {
    initial.value = Expression();
  }
}

void Parser::InitialParts(Initializer& initial) {
  reader_.ExpectMark("{");
  if (!reader_.IsMark("}") && !reader_.IsMark(",")) initial.parts.push_back(ReadInitializer());
  while (reader_.AcceptMark(",")) initial.parts.push_back(ReadInitializer());
  reader_.ExpectMark("}");
  initial.is_compound = !initial.parts.empty();
}

}  // namespace runnel::genom
