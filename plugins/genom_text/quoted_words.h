#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace runnel::genom {

/// The words of a pragma, separated by blanks; what stands in quotation marks is one word, without them.
[[nodiscard]] inline std::vector<std::string> QuotedWords(std::string_view text) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const bool is_quoted = text[at] == '"';
    if (is_quoted) ++at;
    std::size_t end = text.find_first_of(is_quoted ? "\"" : " \t", at);
    if (end == std::string_view::npos) end = text.size();
    words.emplace_back(text.substr(at, end - at));
    at = end + (is_quoted && end < text.size() ? 1 : 0);
  }
  return words;
}

}  // namespace runnel::genom
