#include "core/xml/internal/text_checks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>

namespace runnel::internal {

namespace {

constexpr std::array<std::string_view, 5> kNamedEntities{"amp", "lt", "gt", "quot", "apos"};
constexpr std::string_view kNamedLetters = "&<>\"'";
constexpr std::size_t kLongestEntity = 12;

bool IsXmlCharacter(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF) && code != 0xFFFE && code != 0xFFFF;
}

// Of "#228" or "#xe4".
std::optional<std::uint32_t> NumericEntity(std::string_view name) {
  if (!name.starts_with('#')) return std::nullopt;
  const bool hexadecimal = name.starts_with("#x");
  name.remove_prefix(hexadecimal ? 2 : 1);
  std::uint32_t code = 0;
  const auto [end, error] =
      std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
  const bool is_one =
      error == std::errc() && end == name.data() + name.size() && IsXmlCharacter(code);
  return is_one ? std::optional(code) : std::nullopt;
}

void AppendUtf8(std::uint32_t code, std::string& text) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto add_rest = [&](int shift) { add(0x80U | ((code >> shift) & 0x3FU)); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0U | (code >> 6U));
  } else if (code < 0x10000) {
    add(0xE0U | (code >> 12U));
    add_rest(6);
  } else {
    add(0xF0U | (code >> 18U));
    add_rest(12);
    add_rest(6);
  }
  add_rest(0);
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
  if (NumericEntity(name)) return "";
  return "no entity '" + std::string(text.substr(0, end + 1)) + "'";
}

std::string WithoutEntities(std::string_view text) {
  const std::string plain = WithUsualLineEnds(text);
  std::string result;
  for (std::size_t at = 0; at < plain.size();) {
    const std::size_t begin = std::min(plain.find('&', at), plain.size());
    result.append(plain, at, begin - at);
    if (begin == plain.size()) break;
    const std::size_t end = plain.find(';', begin);
    const std::string_view name = std::string_view(plain).substr(begin + 1, end - begin - 1);
    if (const auto code = NumericEntity(name)) {
      AppendUtf8(*code, result);
    } else {
      const auto known = std::ranges::find(kNamedEntities, name);
      result += kNamedLetters[static_cast<std::size_t>(known - kNamedEntities.begin())];
    }
    at = end + 1;
  }
  return result;
}

std::string WithUsualLineEnds(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      result += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      result += '\n';
    }
  }
  return result;
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
