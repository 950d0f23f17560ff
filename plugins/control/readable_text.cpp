#include "plugins/control/readable_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

namespace runnel {

namespace {

constexpr std::size_t kDigits = 6;

bool BelongsToWord(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_' || character == '.';
}

// The length of the number that the text begins with; 0 if it begins with none, or with a whole one.
std::size_t FractionLength(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view read(text.data(), static_cast<std::size_t>(end - text.data()));
  const bool is_fraction = error == std::errc() && read.find_first_of(".e") != read.npos;
  const bool is_word = text.substr(read.size()).starts_with('.');  // as an address is
  return is_fraction && !is_word && read.find_first_not_of("-") == read.find_first_of("0123456789") ? read.size() : 0;
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
