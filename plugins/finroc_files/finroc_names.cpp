#include "plugins/finroc_files/finroc_names.h"

#include <array>
#include <charconv>

#include "core/base/characters.h"

namespace runnel {

namespace {

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

std::string RunnelName(std::string_view name) {
  const std::string snake = SnakeCase(name);
  return snake.empty() ? "_" : snake;
}

std::string RunnelPath(std::string_view path) {
  std::string result;
  while (!path.empty()) {
    const std::size_t end = path.find('/');
    const std::string_view name = path.substr(0, end);
    path.remove_prefix(end == std::string_view::npos ? path.size() : end + 1);
    if (!name.empty()) result += (result.empty() ? "" : "/") + RunnelName(Decoded(name));
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
    if (library.starts_with(prefix)) return RunnelName(library.substr(prefix.size()));
  }
  return RunnelName(library);
}

}  // namespace runnel
