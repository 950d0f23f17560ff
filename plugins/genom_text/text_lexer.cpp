#include <algorithm>
#include <array>
#include <string_view>

#include "core/base/characters.h"
#include "plugins/genom_text/preprocessor.h"

namespace runnel::genom {

namespace {

using Kind = TextToken::Kind;

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool IsNumeral(char c) { return c >= '0' && c <= '9'; }
bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v' || c == '\r'; }

// The words of the language that have a hyphen.
constexpr std::array<std::string_view, 4> kHyphened = {"codels-requires", "codels-require", "clock-rate", "real-time"};
constexpr std::array<std::string_view, 10> kLongMarks = {"...", "::", "<<", ">>", "<%", "%>", "<:", ":>", "##", "%:"};
constexpr std::string_view kMarks = "{}[]();:?.+-*/%^&|~!=<>,#";

// The text of "/*/ … */": the stars at the beginnings of lines are decoration.
std::string NoticeText(std::string_view comment) {
  std::string text;
  bool at_line_start = false;
  for (const char c : comment) {
    if (at_line_start && (IsBlank(c) || c == '*')) {
      if (c == '*') at_line_start = false;
      continue;
    }
    at_line_start = c == '\n';
    text += c;
  }
  return text;
}

}  // namespace

TextLexer::TextLexer(const std::string& text, int file, Problems& problems) : file_(file), problems_(problems) {
  text_.reserve(text.size() + 1);
  int line = 1;
  lines_.push_back({0, 1, 1});
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::size_t end = i + 1;
    if (text[i] == '\\' && end < text.size() && text[end] == '\r') ++end;
    if (text[i] == '\\' && end < text.size() && text[end] == '\n') {
      lines_.push_back({text_.size(), ++line, 1});
      i = end;
      continue;
    }
    if (text[i] == '\r' && end < text.size() && text[end] == '\n') continue;
    text_ += text[i];
    if (text[i] == '\n') lines_.push_back({text_.size(), ++line, 1});
  }
  if (!text_.empty() && text_.back() != '\n') text_ += '\n';
}

Place TextLexer::here() const {
  auto after = std::ranges::upper_bound(lines_, position_, {}, &LineStart::offset);
  const LineStart& start = *(after - 1);
  return {file_, start.line + line_change_, start.column + static_cast<int>(position_ - start.offset)};
}

void TextLexer::Renumber(int line, int file) {
  line_change_ = 0;
  line_change_ = line - here().line;
  file_ = file;
}

void TextLexer::SkipBlockComment() {
  const Place begin = here();
  const std::size_t end = text_.find("*/", position_ + 2);
  if (end == std::string::npos) {
    problems_.Add(begin, "this comment has no end", "close it by */");
    position_ = text_.size();
    return;
  }
  if (notice_.empty() && At(2) == '/' && end >= position_ + 3) {
    notice_ = NoticeText(std::string_view(text_).substr(position_ + 3, end - position_ - 3));
  }
  position_ = end + 2;
}

bool TextLexer::SkipBlanks() {
  const std::size_t begin = position_;
  while (!IsAtEnd()) {
    if (IsBlank(At())) {
      ++position_;
    } else if (At() == '/' && At(1) == '*') {
      // "/*/" opens a comment, and does not close it.
      SkipBlockComment();
    } else if (At() == '/' && At(1) == '/') {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else {
      break;
    }
  }
  return position_ != begin;
}

std::size_t TextLexer::WordLength() const {
  const std::string_view rest = std::string_view(text_).substr(position_);
  for (const std::string_view word : kHyphened) {
    if (!rest.starts_with(word)) continue;
    const char next = At(word.size());
    if (!IsLetter(next) && !IsNumeral(next)) return word.size();
  }
  std::size_t length = 0;
  while (IsLetter(At(length)) || IsNumeral(At(length))) ++length;
  return length;
}

std::size_t TextLexer::NumberLength() const {
  std::size_t length = 0;
  while (true) {
    const char c = At(length);
    const bool is_sign = (c == '+' || c == '-') && length > 0 && (At(length - 1) == 'e' || At(length - 1) == 'E') &&
                         At(1) != 'x' && At(1) != 'X';
    if (!IsLetter(c) && !IsNumeral(c) && c != '.' && !is_sign) return length;
    ++length;
  }
}

TextToken TextLexer::Take(Kind kind, std::size_t length, Place place) {
  TextToken token{.kind = kind, .text = text_.substr(position_, length), .place = place};
  position_ += length;
  return token;
}

TextToken TextLexer::Quoted(char quote, bool is_directive, Place place) {
  std::size_t length = 1;
  while (position_ + length < text_.size() && At(length) != quote) {
    if (At(length) == '\n' && (is_directive || quote == '\'')) break;
    if (At(length) == '\\' && At(length + 1) != '\n') ++length;
    ++length;
  }
  if (position_ + length >= text_.size() || At(length) != quote) {
    if (!is_directive) {
      problems_.Add(place, quote == '"' ? "this string has no end" : "this character has no end",
                    std::string("close it by ") + quote);
      if (quote == '"') position_ = text_.size();
    }
    if (IsAtEnd()) return {.kind = Kind::kEnd, .place = place};
    return Take(Kind::kStray, 1, place);
  }
  return Take(quote == '"' ? Kind::kString : Kind::kCharacter, length + 1, place);
}

TextToken TextLexer::Next(bool is_directive) {
  const bool has_space = SkipBlanks();
  const Place place = here();
  TextToken token;
  const char c = At();
  if (IsAtEnd()) {
    token = {.kind = Kind::kEnd, .place = place};
  } else if (c == '\n') {
    token = Take(Kind::kNewline, 1, place);
  } else if (IsLetter(c)) {
    token = Take(Kind::kWord, WordLength(), place);
  } else if (IsNumeral(c) || (c == '.' && IsNumeral(At(1)))) {
    token = Take(Kind::kNumber, NumberLength(), place);
  } else if (c == '"' || c == '\'') {
    token = Quoted(c, is_directive, place);
  } else {
    const std::string_view rest = std::string_view(text_).substr(position_);
    const auto mark = std::ranges::find_if(kLongMarks, [&](std::string_view each) { return rest.starts_with(each); });
    if (mark != kLongMarks.end()) {
      token = Take(Kind::kMark, mark->size(), place);
    } else {
      token = Take(kMarks.find(c) == std::string_view::npos ? Kind::kStray : Kind::kMark, 1, place);
    }
  }
  token.has_space_before = has_space;
  return token;
}

std::string TextLexer::RestOfLine() {
  std::string rest;
  bool is_quoted = false;  // where nothing is a comment
  while (!IsAtEnd() && At() != '\n') {
    if (!is_quoted && At() == '/' && (At(1) == '*' || At(1) == '/')) {
      SkipBlanks();
      rest += ' ';
      continue;
    }
    if (At() == '"') is_quoted = !is_quoted;
    if (is_quoted && At() == '\\' && At(1) != '\n') rest += text_[position_++];
    rest += text_[position_++];
  }
  return std::string(Trimmed(rest));
}

std::vector<TextToken> TextLexer::LineTokens() {
  std::vector<TextToken> tokens;
  for (TextToken next = Next(true); next.kind != Kind::kNewline && next.kind != Kind::kEnd; next = Next(true)) {
    tokens.push_back(std::move(next));
  }
  return tokens;
}

bool TextLexer::SkipToDirective() {
  while (!IsAtEnd()) {
    SkipBlanks();
    if (At() == '#') {
      ++position_;
      return true;
    }
    (void)RestOfLine();
    ++position_;
  }
  position_ = text_.size();
  return false;
}

}  // namespace runnel::genom
