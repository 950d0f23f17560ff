#include "plugins/values/json_writer.h"

#include "core/base/characters.h"

namespace runnel {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";

void AppendAscii(char character, std::string& json) {
  constexpr std::string_view kMeant = "\"\\\n\t\r", kNames = "\"\\ntr", kDigits = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(character);
  if (const auto named = kMeant.find(character); named != std::string_view::npos) {
    json.append({'\\', kNames[named]});
  } else if (byte < 0x20 || byte == 0x7f) {
    json.append("\\u00").append({kDigits[byte >> 4], kDigits[byte & 15]});
  } else {
    json += character;
  }
}

}  // namespace

void AppendJsonString(std::string_view text, std::string& json) {
  json += '"';
  while (!text.empty()) {
    if (static_cast<unsigned char>(text.front()) < 0x80) {
      AppendAscii(text.front(), json);
      text.remove_prefix(1);
      continue;
    }
    const std::size_t length = CharacterLength(text);
    json += length > 0 ? text.substr(0, length) : kReplacement;
    text.remove_prefix(length > 0 ? length : 1);
  }
  json += '"';
}

}  // namespace runnel
