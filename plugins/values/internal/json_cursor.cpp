#include "plugins/values/internal/json_cursor.h"

#include <algorithm>
#include <cctype>

#include <locale.h>
#include <stdlib.h>

#include "core/base/characters.h"
#include "plugins/values/json_writer.h"

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

void JsonCursor::Need(char character, std::string_view what, std::string_view of) {
  if (!Skip(character)) FailExpecting(std::string(what).append(of));
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

unsigned JsonCursor::TakeFourDigits() {
  unsigned number = 0;
  for (int i = 0; i < 4; ++i, ++next_) {
    const int digit = DigitOf(At(next_));
    if (digit < 0) Fail("\\u wants four hexadecimal digits");
    number = number * 16 + static_cast<unsigned>(digit);
  }
  return number;
}

void JsonCursor::TakeEscape(std::string& text) {
  constexpr std::string_view kNames = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
  const char name = At(next_);
  if (const auto known = kNames.find(name); known != std::string_view::npos && name != '\0') {
    text += kMeant[known];
    ++next_;
    return;
  }
  if (name != 'u') Fail("there is no such escape in JSON");
  ++next_;
  unsigned code_point = TakeFourDigits();
  if (code_point >= 0xd800 && code_point < 0xdc00 && At(next_) == '\\' && At(next_ + 1) == 'u') {
    next_ += 2;
    const unsigned second = TakeFourDigits();
    const bool is_pair = second >= 0xdc00 && second <= 0xdfff;
    if (is_pair) code_point = 0x10000 + ((code_point - 0xd800) << 10) + (second - 0xdc00);
  }
  if (code_point >= 0xd800 && code_point <= 0xdfff) Fail("half a surrogate pair is no character");
  AppendUtf8(code_point, text);
}

void JsonCursor::TakeString(std::string& text) {
  if (!Skip('"')) FailExpecting("a text in quotation marks");
  text.clear();
  while (next_ < text_.size()) {
    const char character = text_[next_];
    if (character == '"') {
      ++next_;
      return;
    }
    if (character == '\\') {
      ++next_;
      TakeEscape(text);
      continue;
    }
    if (static_cast<unsigned char>(character) < 0x20) {
      Fail("a control character in a text must be escaped");
    }
    const std::size_t length = CharacterLength(text_.substr(next_));
    if (length == 0) Fail("this is no UTF-8");
    text += text_.substr(next_, length);
    next_ += length;
  }
  Fail("a text has no end");
}

void JsonCursor::GoPast(int depth) {
  std::string text;
  const char next = Peek();
  is_too_deep_ = depth <= 0 && (next == '{' || next == '[');
  if (is_too_deep_) Fail("");
  if (next == '"') return TakeString(text);
  if (next == '{' || next == '[') {
    const char end = next == '{' ? '}' : ']';
    Skip(next);
    if (Skip(end)) return;
    do {
      if (next == '{') {
        TakeString(text);
        Need(':', "':'");
      }
      GoPast(depth - 1);
    } while (Skip(','));
    return Need(end, "the end");
  }
  const bool is_one =
      SkipWord("true") || SkipWord("false") || SkipWord("null") || !TakeNumber().empty();
  if (!is_one) Fail("");
}

bool JsonCursor::SkipValue(int depth) {
  try {
    GoPast(depth);
    return true;
  } catch (const JsonFailure&) {  // callers know better what they have expected
    return false;
  }
}

std::string_view JsonCursor::TakeValue() {
  SkipWhitespace();
  const std::size_t begin = next_;
  SkipValue(std::numeric_limits<int>::max());
  return text_.substr(begin, next_ - begin);
}

Error JsonCursor::ErrorAt(std::size_t place, std::string message) const {
  const std::string_view before = text_.substr(0, place);
  const auto line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return {.message = std::move(message),
          .position = {"", 1 + static_cast<int>(std::ranges::count(before, '\n')),
                       1 + static_cast<int>(place - line_begin)}};
}

Error JsonCursor::ExpectedAt(std::size_t place, std::string_view what) const {
  constexpr std::size_t kShown = 20;
  const std::string_view rest = text_.substr(place);
  std::string found;
  AppendJsonString(rest.substr(0, WholeCharacters(rest, kShown)), found);
  return ErrorAt(place,
                 "expected " + std::string(what) + ", found " +
                     (rest.empty() ? "the end" : "'" + found.substr(1, found.size() - 2) + "'"));
}

void JsonCursor::FailAt(std::size_t place, std::string message, std::string hint) const {
  Error error = ErrorAt(place, std::move(message));
  error.hint = std::move(hint);
  throw JsonFailure{std::move(error)};
}

void JsonCursor::FailExpecting(const std::string& what) {
  SkipWhitespace();
  throw JsonFailure{ExpectedAt(next_, what)};
}

double DoubleOf(std::string_view digits) {
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec == std::errc()) return number;
  // Beyond what a double can say; this tells whether it is huge or tiny, whatever the program's locale.
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(std::string(digits).c_str(), nullptr, plain);
}

}  // namespace runnel
