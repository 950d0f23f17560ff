#include "core/types/internal/text_cursor.h"

#include <cctype>

namespace runnel {

namespace {

constexpr std::string_view kWhitespace = " \t\r\n";

bool IsOfWord(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_';
}

}  // namespace

std::string_view WithoutWhitespace(std::string_view text) {
  const auto begin = text.find_first_not_of(kWhitespace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhitespace) - begin + 1);
}

void TextCursor::SkipWhitespace() {
  const auto next = rest_.find_first_not_of(kWhitespace);
  rest_.remove_prefix(next == std::string_view::npos ? rest_.size() : next);
}

bool TextCursor::AtEnd() {
  SkipWhitespace();
  return rest_.empty();
}

bool TextCursor::Skip(char character) {
  SkipWhitespace();
  if (!rest_.starts_with(character)) return false;
  rest_.remove_prefix(1);
  return true;
}

std::string_view TextCursor::TakeWord() {
  SkipWhitespace();
  std::size_t length = 0;
  while (length < rest_.size() && IsOfWord(rest_[length])) ++length;
  const std::string_view word = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return word;
}

std::string_view TextCursor::TakeToken() {
  SkipWhitespace();
  const std::string_view token = rest_.substr(0, rest_.find_first_of(",:]}"));
  rest_.remove_prefix(token.size());
  return WithoutWhitespace(token);
}

bool TextCursor::TakeQuoted(std::string& text) {
  SkipWhitespace();
  if (!rest_.starts_with('"')) return false;
  for (std::size_t i = 1; i < rest_.size(); ++i) {
    if (rest_[i] == '"') {
      rest_.remove_prefix(i + 1);
      return true;
    }
    if (rest_[i] != '\\') {
      text += rest_[i];
      continue;
    }
    if (++i == rest_.size()) return false;
    const char name = rest_[i];
    text += name == 'n' ? '\n' : name == 't' ? '\t' : name == 'r' ? '\r' : name;
  }
  return false;
}

Error TextCursor::Expected(const std::string& what) {
  SkipWhitespace();
  const std::string where = rest_.empty() ? "at the end" : "before '" + std::string(rest_) + "'";
  return {.message = "expected " + what + " " + where + " of '" + std::string(all_) + "'"};
}

}  // namespace runnel
