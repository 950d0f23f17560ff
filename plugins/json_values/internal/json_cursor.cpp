#include "plugins/json_values/internal/json_cursor.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/base/characters.h"
#include "plugins/json_values/json_writer.h"

namespace runnel {

namespace {

bool IsWhitespace(char character) {
  return character == ' ' || character == '\t' || character == '\r' || character == '\n';
}
bool IsDigit(char character) { return character >= '0' && character <= '9'; }

// Letters and digits that are glued to a word or a number make it another, wrong one.
bool IsOfWord(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_' ||
         character == '.' || character == '+' || character == '-';
}

int DigitOf(char character) {
  if (IsDigit(character)) return character - '0';
  if (character >= 'a' && character <= 'f') return character - 'a' + 10;
  if (character >= 'A' && character <= 'F') return character - 'A' + 10;
  return -1;
}

}  // namespace

void JsonCursor::SkipWhitespace() {
  while (next_ < text_.size() && IsWhitespace(text_[next_])) ++next_;
}

char JsonCursor::Peek() {
  SkipWhitespace();
  return At(next_);
}

bool JsonCursor::AtEnd() {
  SkipWhitespace();
  return next_ == text_.size();
}

bool JsonCursor::Skip(char character) {
  SkipWhitespace();
  if (next_ == text_.size() || text_[next_] != character) return false;
  ++next_;
  return true;
}

bool JsonCursor::SkipWord(std::string_view word) {
  SkipWhitespace();
  if (!text_.substr(next_).starts_with(word) || IsOfWord(At(next_ + word.size()))) return false;
  next_ += word.size();
  return true;
}

std::size_t JsonCursor::EndOfDigits(std::size_t from) const {
  while (IsDigit(At(from))) ++from;
  return from;
}

std::string_view JsonCursor::TakeNumber() {
  SkipWhitespace();
  std::size_t end = next_;
  if (At(end) == '-') ++end;
  if (!IsDigit(At(end))) return {};
  end = At(end) == '0' ? end + 1 : EndOfDigits(end);
  if (At(end) == '.') {
    const std::size_t digits = end + 1;
    end = EndOfDigits(digits);
    if (end == digits) return {};
  }
  if (At(end) == 'e' || At(end) == 'E') {
    const std::size_t digits = At(end + 1) == '+' || At(end + 1) == '-' ? end + 2 : end + 1;
    end = EndOfDigits(digits);
    if (end == digits) return {};
  }
  if (IsOfWord(At(end))) return {};
  const std::string_view number = text_.substr(next_, end - next_);
  next_ = end;
  return number;
}

Result<unsigned> JsonCursor::TakeFourDigits() {
  unsigned number = 0;
  for (int i = 0; i < 4; ++i, ++next_) {
    const int digit = DigitOf(At(next_));
    if (digit < 0) return ErrorHere("\\u wants four hexadecimal digits");
    number = number * 16 + static_cast<unsigned>(digit);
  }
  return number;
}

Result<void> JsonCursor::TakeEscape(std::string& text) {
  constexpr std::string_view kNames = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
  const char name = At(next_);
  if (const auto known = kNames.find(name); known != std::string_view::npos && name != '\0') {
    text += kMeant[known];
    ++next_;
    return {};
  }
  if (name != 'u') return ErrorHere("there is no such escape in JSON");
  ++next_;
  const auto first = TakeFourDigits();
  if (!first) return first.error();
  unsigned code_point = *first;
  if (code_point >= 0xd800 && code_point < 0xdc00 && At(next_) == '\\' && At(next_ + 1) == 'u') {
    next_ += 2;
    const auto second = TakeFourDigits();
    if (!second) return second.error();
    if (*second < 0xdc00 || *second > 0xdfff)
      return ErrorHere("half a surrogate pair is no character");
    code_point = 0x10000 + ((code_point - 0xd800) << 10) + (*second - 0xdc00);
  }
  if (code_point >= 0xd800 && code_point <= 0xdfff) {
    return ErrorHere("half a surrogate pair is no character");
  }
  AppendUtf8(code_point, text);
  return {};
}

Result<void> JsonCursor::TakeString(std::string& text) {
  if (!Skip('"')) return Expected("a text in quotation marks");
  text.clear();
  while (next_ < text_.size()) {
    const char character = text_[next_];
    if (character == '"') {
      ++next_;
      return {};
    }
    if (character == '\\') {
      ++next_;
      if (auto taken = TakeEscape(text); !taken) return taken;
      continue;
    }
    if (static_cast<unsigned char>(character) < 0x20) {
      return ErrorHere("a control character in a text must be escaped");
    }
    const std::size_t length = CharacterLength(text_.substr(next_));
    if (length == 0) return ErrorHere("this is no UTF-8");
    text += text_.substr(next_, length);
    next_ += length;
  }
  return ErrorHere("a text has no end");
}

bool JsonCursor::SkipValue(int depth) {
  std::string text;
  const char next = Peek();
  if (depth <= 0 && (next == '{' || next == '[')) {
    is_too_deep_ = true;
    return false;
  }
  switch (next) {
    case '"':
      return TakeString(text).has_value();
    case '{':
      Skip('{');
      if (Skip('}')) return true;
      do {
        if (!TakeString(text) || !Skip(':') || !SkipValue(depth - 1)) return false;
      } while (Skip(','));
      return Skip('}');
    case '[':
      Skip('[');
      if (Skip(']')) return true;
      do {
        if (!SkipValue(depth - 1)) return false;
      } while (Skip(','));
      return Skip(']');
    default:
      return SkipWord("true") || SkipWord("false") || SkipWord("null") || !TakeNumber().empty();
  }
}

std::string_view JsonCursor::TakeValue() {
  SkipWhitespace();
  const std::size_t begin = next_;
  SkipValue(std::numeric_limits<int>::max());
  return text_.substr(begin, next_ - begin);
}

Error JsonCursor::ErrorHere(std::string message) {
  const std::string_view before = text_.substr(0, next_);
  const auto line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return {.message = std::move(message),
          .position = {"", 1 + static_cast<int>(std::ranges::count(before, '\n')),
                       1 + static_cast<int>(next_ - line_begin)}};
}

Error JsonCursor::Expected(const std::string& what) {
  SkipWhitespace();
  constexpr std::size_t kShown = 20;
  const std::string_view rest = text_.substr(next_);
  std::string found;
  AppendJsonString(rest.substr(0, WholeCharacters(rest, kShown)), found);
  return ErrorHere("expected " + what + ", found " +
                   (rest.empty() ? "the end" : "'" + found.substr(1, found.size() - 2) + "'"));
}

}  // namespace runnel
