#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace runnel {

/// Texts are UTF-8; here is what a character of one is, and which of them files can carry.

/// How many bytes the first character of `text` has, 1 to 4; 0 if the text does not begin with UTF-8
/// as it must be written (RFC 3629: the shortest form, no surrogates, nothing beyond U+10FFFF).
[[nodiscard]] std::size_t CharacterLength(std::string_view text) noexcept;

/// The same; 0 also for a character that no XML file can carry, not even as an entity: U+FFFE, U+FFFF
/// and the control characters but tabulator, line feed and carriage return.
[[nodiscard]] std::size_t FileCharacterLength(std::string_view text) noexcept;

/// What errors call the first character of `text` that no file can carry: "control character 0x07",
/// "byte 0xff, which is no UTF-8". "" if there is none.
[[nodiscard]] std::string UnwritableCharacter(std::string_view text);

/// Precondition: a code point that may be written: not a surrogate, at most U+10FFFF.
void AppendUtf8(unsigned code_point, std::string& text);

}  // namespace runnel
