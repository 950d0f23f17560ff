#include "plugins/values/base64.h"

#include "core/types/type_info.h"

namespace runnel {

namespace {

constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

void AppendBase64(std::string_view bytes, std::string& text) {
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += kBase64Digits[three >> 18 & 63];
    text += kBase64Digits[three >> 12 & 63];
    text += i + 1 < bytes.size() ? kBase64Digits[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kBase64Digits[three & 63] : '=';
  }
}

void AppendBase64(const TypeInfo& list, const void* value, std::string& json) {
  const ElementOperations& elements = list.elements();
  const std::size_t count = elements.columns(value);
  const auto at = [&](std::size_t index) {
    return static_cast<const char*>(elements.element(ForLooking(value), index));
  };
  json += '"';
  if (count > 0 && elements.are_plain_numbers) {
    AppendBase64({at(0), count}, json);
  } else {
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) bytes += *at(i);
    AppendBase64(bytes, json);
  }
  json += '"';
}

std::optional<std::string> FromBase64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char character : text) {
    const std::size_t digit = kBase64Digits.find(character);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

}  // namespace runnel
