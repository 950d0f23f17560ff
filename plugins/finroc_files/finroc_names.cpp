#include "plugins/finroc_files/finroc_names.h"

#include <array>
#include <charconv>

namespace runnel {

namespace {

bool IsUpper(char character) { return character >= 'A' && character <= 'Z'; }
bool IsLowerOrDigit(char character) {
  return (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9');
}

// "%3C" → "<".
std::string Decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    int code = 0;
    const bool may_be_code = text[i] == '%' && i + 2 < text.size();
    if (may_be_code && std::from_chars(text.data() + i + 1, text.data() + i + 3, code, 16).ptr == text.data() + i + 3) {
      decoded += static_cast<char>(code);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

}  // namespace

std::string SnakeCase(std::string_view name) {
  std::string snake;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char character = name[i];
    if (IsUpper(character)) {
      const bool follows_small = i > 0 && IsLowerOrDigit(name[i - 1]);
      const bool ends_capitals =
          i > 0 && IsUpper(name[i - 1]) && i + 1 < name.size() && name[i + 1] >= 'a' && name[i + 1] <= 'z';
      if (follows_small || ends_capitals) snake += '_';
      snake += static_cast<char>(character - 'A' + 'a');
    } else if (IsLowerOrDigit(character)) {
      snake += character;
    } else if (!snake.empty() && snake.back() != '_') {
      snake += '_';
    }
  }
  while (!snake.empty() && snake.back() == '_') snake.pop_back();
  return snake.empty() ? "_" : snake;
}

std::string SnakeCasePath(std::string_view path) {
  std::string result;
  while (!path.empty()) {
    const std::size_t end = path.find('/');
    const std::string_view name = path.substr(0, end);
    path.remove_prefix(end == std::string_view::npos ? path.size() : end + 1);
    if (!name.empty()) result += (result.empty() ? "" : "/") + SnakeCase(Decoded(name));
  }
  return result;
}

std::string WithoutLast(const std::string& path, int count) {
  std::string rest = path;
  for (int i = 0; i < count; ++i) {
    const std::size_t end = rest.rfind('/');
    rest.erase(end == std::string::npos ? 0 : end);
  }
  return rest;
}

std::string LastName(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string LibraryName(std::string_view library) {
  constexpr std::array<std::string_view, 5> kPrefixes{"finroc_projects_", "finroc_plugins_", "finroc_libraries_",
                                                      "finroc_", "rrlib_"};
  for (const std::string_view prefix : kPrefixes) {
    if (library.starts_with(prefix)) return SnakeCase(library.substr(prefix.size()));
  }
  return SnakeCase(library);
}

}  // namespace runnel
