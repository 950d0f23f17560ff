#include "core/base/characters.h"

#include <algorithm>
#include <array>

namespace runnel {

namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

bool IsInner(char byte) noexcept { return (static_cast<unsigned char>(byte) & 0xc0U) == 0x80U; }

}  // namespace

std::size_t CharacterLength(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
  };
  const auto is_inner = [&](std::size_t i) { return (byte(i) & 0xc0) == 0x80; };
  const unsigned first = byte(0);
  if (text.empty()) return 0;
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return is_inner(1) ? 2 : 0;
  if ((first & 0xf0) == 0xe0) {
    const bool is_longer_form = first == 0xe0 && byte(1) < 0xa0;
    const bool is_surrogate = first == 0xed && byte(1) >= 0xa0;
    return is_inner(1) && is_inner(2) && !is_longer_form && !is_surrogate ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool is_longer_form = first == 0xf0 && byte(1) < 0x90;
    const bool is_beyond = first == 0xf4 && byte(1) >= 0x90;
    return is_inner(1) && is_inner(2) && is_inner(3) && !is_longer_form && !is_beyond ? 4 : 0;
  }
  return 0;
}

std::size_t FileCharacterLength(std::string_view text) noexcept {
  const std::size_t length = CharacterLength(text);
  if (length == 1) {
    const char character = text.front();
    const bool is_control = static_cast<unsigned char>(character) < 0x20;
    return is_control && character != '\t' && character != '\n' && character != '\r' ? 0 : 1;
  }
  const bool is_no_character = text.starts_with("\xef\xbf\xbe") || text.starts_with("\xef\xbf\xbf");
  return is_no_character ? 0 : length;
}

std::string UnwritableCharacter(std::string_view text) {
  for (std::size_t length = 0; !text.empty(); text.remove_prefix(length)) {
    length = FileCharacterLength(text);
    if (length > 0) continue;
    const auto byte = static_cast<unsigned char>(text.front());
    const std::string number{'0', 'x', kDigits[byte / 16U], kDigits[byte % 16U]};
    if (byte < 0x80) return "control character " + number;
    if (CharacterLength(text) == 0) return "byte " + number + ", which is no UTF-8";
    return text.starts_with("\xef\xbf\xbe") ? "U+FFFE, which is no character" : "U+FFFF, which is no character";
  }
  return "";
}

std::size_t CharacterCount(std::string_view text) noexcept {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, IsInner));
}

std::size_t WholeCharacters(std::string_view text, std::size_t most) noexcept {
  if (text.size() <= most) return text.size();
  std::size_t end = most;
  while (end > 0 && most - end < 3 && IsInner(text[end])) --end;
  return IsInner(text[end]) ? most : end;
}

std::string Shortened(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  text.resize(WholeCharacters(text, most));
  return text + "…";
}

std::string_view Trimmed(std::string_view text) noexcept {
  constexpr std::string_view kWhitespace = " \t\r\n\f\v";
  const std::size_t begin = text.find_first_not_of(kWhitespace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhitespace) - begin + 1);
}

std::vector<std::string_view> PartsBetween(std::string_view separators, std::string_view text) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    if (end > 0) parts.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

std::string Quoted(std::string_view text) {
  constexpr std::string_view kMeant = "\"\\\n\t\r", kNames = "\"\\ntr";
  std::string quoted = "\"";
  for (const char character : text) {
    const std::size_t escaped = kMeant.find(character);
    if (escaped != std::string_view::npos) quoted += '\\';
    quoted += escaped != std::string_view::npos ? kNames[escaped] : character;
  }
  return quoted + '"';
}

std::string EscapedMarkup(std::string_view text) {
  constexpr std::string_view kMeant = "&<>\"";
  constexpr std::array kNames{"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string escaped;
  for (const char character : text) {
    const std::size_t named = kMeant.find(character);
    escaped += named != std::string_view::npos ? kNames[named] : std::string(1, character);
  }
  return escaped;
}

std::string Printable(std::string_view text, std::string_view kept) {
  std::string printable;
  for (std::size_t length = 0; !text.empty(); text.remove_prefix(length)) {
    length = std::max<std::size_t>(CharacterLength(text), 1);
    const auto byte = static_cast<unsigned char>(text.front());
    const bool is_late_control = byte == 0xc2 && length == 2 && static_cast<unsigned char>(text[1]) < 0xa0;
    const bool is_shown = byte < 0x80 ? byte >= 0x20 && byte != 0x7f : length > 1 && !is_late_control;
    if (is_shown || kept.find(text.front()) != std::string_view::npos) {
      printable += text.substr(0, length);
      continue;
    }
    length = 1;  // of a late control character the second byte follows
    printable += {'\\', 'x', kDigits[byte / 16U], kDigits[byte % 16U]};
  }
  return printable;
}

namespace {

// Each between blanks.
constexpr std::string_view kKeywords =
    " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class "
    "co_await "
    "co_return co_yield compl concept const const_cast consteval constexpr constinit continue decltype default delete "
    "do "
    "double dynamic_cast else enum explicit export extern false float for friend goto if inline int long mutable "
    "namespace "
    "new noexcept not not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires "
    "return "
    "short signed sizeof static static_assert static_cast struct switch template this thread_local throw true try "
    "typedef "
    "typeid typename union unsigned using virtual void volatile wchar_t while xor xor_eq ";

bool IsLower(char c) { return c >= 'a' && c <= 'z'; }
bool IsUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool IsLowerOrDigit(char c) { return IsLower(c) || (c >= '0' && c <= '9'); }

}  // namespace

bool IsSnakeCase(std::string_view name) noexcept {
  return !name.empty() && IsLower(name.front()) && name.back() != '_' && name.find("__") == std::string_view::npos &&
         std::ranges::all_of(name, [](char c) { return IsLowerOrDigit(c) || c == '_'; });
}

std::string SnakeCase(std::string_view name) {
  std::string snake;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool follows_small = i > 0 && IsLowerOrDigit(name[i - 1]);
    const bool ends_capitals = i > 0 && IsUpper(name[i - 1]) && i + 1 < name.size() && IsLower(name[i + 1]);
    const bool begins_word = IsUpper(c) ? follows_small || ends_capitals : !IsLowerOrDigit(c);
    if (begins_word && !snake.empty() && snake.back() != '_') snake += '_';
    if (IsUpper(c)) snake += static_cast<char>(c - 'A' + 'a');
    if (IsLowerOrDigit(c)) snake += c;
  }
  while (snake.ends_with('_')) snake.pop_back();
  return snake;
}

std::string CamelCase(std::string_view name) {
  std::string camel;
  bool begins_word = true;
  for (const char c : name) {
    if (IsLower(c) && begins_word) {
      camel += static_cast<char>(c - 'a' + 'A');
    } else if (IsLowerOrDigit(c) || IsUpper(c)) {
      camel += c;
    }
    begins_word = !IsLowerOrDigit(c) && !IsUpper(c);
  }
  return camel;
}

bool IsCppKeyword(std::string_view word) {
  return word.find(' ') == std::string_view::npos &&
         kKeywords.find(" " + std::string(word) + " ") != std::string_view::npos;
}

}  // namespace runnel
