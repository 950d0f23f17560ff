#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace runnel {

/// How many bytes the first letter of `text` has, 1 to 4; 0 if the text does not begin with UTF-8 as
/// it must be written (RFC 3629: no detours, no surrogates, nothing beyond U+10FFFF).
[[nodiscard]] inline std::size_t LengthOfLetter(std::string_view text) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
  };
  const auto is_inner = [&](std::size_t i) { return (byte(i) & 0xc0) == 0x80; };
  const unsigned first = byte(0);
  if (text.empty()) return 0;
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf) return is_inner(1) ? 2 : 0;
  if ((first & 0xf0) == 0xe0) {
    const bool is_detour = first == 0xe0 && byte(1) < 0xa0;
    const bool is_surrogate = first == 0xed && byte(1) >= 0xa0;
    return is_inner(1) && is_inner(2) && !is_detour && !is_surrogate ? 3 : 0;
  }
  if (first >= 0xf0 && first <= 0xf4) {
    const bool is_detour = first == 0xf0 && byte(1) < 0x90;
    const bool is_beyond = first == 0xf4 && byte(1) >= 0x90;
    return is_inner(1) && is_inner(2) && is_inner(3) && !is_detour && !is_beyond ? 4 : 0;
  }
  return 0;
}

/// Precondition: a code point that may be written: not a surrogate, at most U+10FFFF.
inline void AppendUtf8(unsigned code_point, std::string& text) {
  const auto inner = [&](unsigned shift) {
    text += static_cast<char>(0x80 | (code_point >> shift & 0x3f));
  };
  if (code_point < 0x80) {
    text += static_cast<char>(code_point);
  } else if (code_point < 0x800) {
    text += static_cast<char>(0xc0 | code_point >> 6);
    inner(0);
  } else if (code_point < 0x10000) {
    text += static_cast<char>(0xe0 | code_point >> 12);
    inner(6);
    inner(0);
  } else {
    text += static_cast<char>(0xf0 | code_point >> 18);
    inner(12);
    inner(6);
    inner(0);
  }
}

}  // namespace runnel
