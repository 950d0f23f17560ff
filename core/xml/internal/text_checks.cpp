#include "core/xml/internal/text_checks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace runnel::internal {

namespace {

constexpr std::array<std::string_view, 5> kNamedEntities{"amp", "lt", "gt", "quot", "apos"};
constexpr std::size_t kLongestEntity = 12;

bool IsXmlCharacter(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF) && code != 0xFFFE && code != 0xFFFF;
}

bool IsNumericEntity(std::string_view name) {
  if (!name.starts_with('#')) return false;
  const bool hexadecimal = name.starts_with("#x");
  name.remove_prefix(hexadecimal ? 2 : 1);
  std::uint32_t code = 0;
  const auto [end, error] =
      std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
  return error == std::errc() && end == name.data() + name.size() && IsXmlCharacter(code);
}

}  // namespace

std::string EntityFault(std::string_view text) {
  text = text.substr(0, kLongestEntity);
  const auto is_of_name = [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '#';
  };
  const auto behind = std::find_if_not(text.begin() + 1, text.end(), is_of_name);
  const auto end = static_cast<std::size_t>(behind - text.begin());
  if (end == text.size() || text[end] != ';') return "'&' begins an entity that no ';' ends";
  const std::string_view name = text.substr(1, end - 1);
  if (std::ranges::find(kNamedEntities, name) != kNamedEntities.end()) return "";
  if (IsNumericEntity(name)) return "";
  return "no entity '" + std::string(text.substr(0, end + 1)) + "'";
}

std::string DeclaredEncoding(std::string_view declaration) {
  constexpr std::string_view kWord = "encoding";
  const std::size_t word = declaration.find(kWord);
  if (!declaration.starts_with("<?xml") || word == std::string_view::npos) return "";
  const std::size_t opening = declaration.find_first_of("\"'", word + kWord.size());
  if (opening == std::string_view::npos) return "";
  const std::string_view value = declaration.substr(opening + 1);
  return std::string(value.substr(0, value.find(declaration[opening])));
}

bool IsReadableEncoding(std::string_view encoding) {
  std::string lower(encoding);
  for (char& character : lower) {
    if (character >= 'A' && character <= 'Z') character = static_cast<char>(character - 'A' + 'a');
  }
  constexpr std::array<std::string_view, 5> kReadable{"", "utf-8", "utf8", "us-ascii", "ascii"};
  return std::ranges::find(kReadable, lower) != kReadable.end();
}

}  // namespace runnel::internal
