#include "core/base/identifier.h"

#include <algorithm>

namespace runnel {

namespace {

// Each between blanks.
constexpr std::string_view kKeywords =
    " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class "
    "co_await co_return co_yield compl concept const const_cast consteval constexpr constinit continue decltype "
    "default delete do double dynamic_cast else enum explicit export extern false float for friend goto if inline int "
    "long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public register "
    "reinterpret_cast requires return short signed sizeof static static_assert static_cast struct switch template "
    "this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t "
    "while xor xor_eq ";

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
