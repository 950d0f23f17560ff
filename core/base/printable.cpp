#include "core/base/printable.h"

#include <algorithm>

#include "core/base/characters.h"

namespace runnel {

std::string Printable(std::string_view text, std::string_view kept) {
  constexpr std::string_view kDigits = "0123456789abcdef";
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

}  // namespace runnel
