#include "plugins/control/readable_text.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include <fmt/format.h>

namespace runnel {

namespace {

constexpr std::size_t kDigits = 6;

bool IsDigit(char character) { return character >= '0' && character <= '9'; }
bool BelongsToWord(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_' || character == '.';
}

// The length of the number that the text begins with; 0 if it begins with none, or with a whole one.
std::size_t FractionLength(std::string_view text) {
  std::size_t at = text.starts_with('-') ? 1 : 0;
  if (at == text.size() || !IsDigit(text[at])) return 0;
  bool is_fraction = false;
  while (at < text.size() && (IsDigit(text[at]) || text[at] == '.')) is_fraction |= text[at++] == '.';
  if (at < text.size() && text[at] == 'e') {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '-' || text[exponent] == '+')) ++exponent;
    if (exponent < text.size() && IsDigit(text[exponent])) {
      is_fraction = true;
      at = exponent;
      while (at < text.size() && IsDigit(text[at])) ++at;
    }
  }
  return is_fraction ? at : 0;
}

}  // namespace

std::string ReadableNumbers(std::string_view text) {
  std::string readable;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    if (text[at] == '"') {
      while (at + length < text.size() && text[at + length] != '"') length += text[at + length] == '\\' ? 2 : 1;
      length = std::min(length + 1, text.size() - at);
    } else if (const std::size_t number = FractionLength(text.substr(at)); number > 0) {
      const std::string word(text.substr(at, number));
      if (number > kDigits + 1) {
        readable += fmt::format("{:.{}g}", std::strtod(word.c_str(), nullptr), kDigits);
      } else {
        readable += word;
      }
      at += number;
      continue;
    } else {
      while (BelongsToWord(text[at]) && at + length < text.size() && BelongsToWord(text[at + length])) ++length;
    }
    readable += text.substr(at, length);
    at += length;
  }
  return readable;
}

}  // namespace runnel
