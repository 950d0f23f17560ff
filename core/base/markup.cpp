#include "core/base/markup.h"

#include <array>

namespace runnel {

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

}  // namespace runnel
