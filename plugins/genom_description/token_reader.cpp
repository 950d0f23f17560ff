#include "plugins/genom_description/parser.h"

namespace runnel::genom {

const Token& TokenReader::Peek() {
  while (tokens_[at_].kind == Token::Kind::kPragma) on_pragma_(tokens_[at_++]);
  return tokens_[at_];
}

Token TokenReader::Take() {
  const Token& token = Peek();
  last_ = token.place;
  last_.column += static_cast<int>(token.text.size());
  if (token.kind != Token::Kind::kEnd) ++at_;
  return token;
}

bool TokenReader::AcceptMark(std::string_view mark) {
  if (!IsMark(mark)) return false;
  Take();
  return true;
}

bool TokenReader::AcceptWord(std::string_view word) {
  if (!IsWord(word)) return false;
  Take();
  return true;
}

void TokenReader::Fail(const std::string& expected, std::string hint) {
  const Token& token = Peek();
  std::string message = "there should be " + expected + ", not " + token.Name();
  if (token.kind == Token::Kind::kWord && IsReserved(token.text) && hint.empty()) {
    hint = "'" + token.text + "' is a word of the language, and can name nothing";
  }
  problems_.Add(token.place, std::move(message), std::move(hint));
  throw SyntaxError{};
}

void TokenReader::ExpectMark(std::string_view mark) {
  if (!AcceptMark(mark)) Fail("'" + std::string(mark) + "'");
}

void TokenReader::ExpectClosingAngle() {
  if (IsMark(">>")) {
    tokens_[at_].text = ">";
    ++tokens_[at_].place.column;
    return;
  }
  ExpectMark(">");
}

bool TokenReader::IsIdentifier() {
  const Token& token = Peek();
  return token.kind == Token::Kind::kWord && !IsReserved(token.text);
}

Token TokenReader::Identifier(std::string_view of) {
  if (!IsIdentifier()) Fail("the name of " + std::string(of));
  if (IsWord("native") || IsWord("exception")) {
    problems_.Add(Peek().place, "'" + Peek().text + "' is a word of the language, and can name nothing");
  }
  return Take();
}

void TokenReader::Semicolon() {
  if (AcceptMark(";")) return;
  problems_.Add(last_.line > 0 ? last_ : Peek().place, "';' is missing before " + Peek().Name());
}

void TokenReader::SkipStatement() {
  std::size_t open = 0;
  while (Peek().kind != Token::Kind::kEnd) {
    if (open == 0 && IsMark("}")) return;
    const Token token = Take();
    if (token.IsMark("{")) ++open;
    if (token.IsMark("}")) --open;
    if (open == 0 && token.IsMark(";")) return;
  }
}

TokenReader::Depth::Depth(TokenReader& reader) : reader_(reader) {
  if (++reader_.depth_ <= kDeepest) return;
  --reader_.depth_;
  reader_.Fail("something that is nested less deeply");
}

}  // namespace runnel::genom
