#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

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

/// How many characters there are: how wide the text is for people. Stray bytes within it count as none.
[[nodiscard]] std::size_t CharacterCount(std::string_view text) noexcept;

/// How many of the first `most` bytes of a text hold whole characters, so that it is not cut in one.
[[nodiscard]] std::size_t WholeCharacters(std::string_view text, std::size_t most) noexcept;

/// The text, or so much of it as fits into `most` bytes, and "…".
[[nodiscard]] std::string Shortened(std::string text, std::size_t most);

/// `text` without the white space at its ends.
[[nodiscard]] std::string_view Trimmed(std::string_view text) noexcept;

/// What stands between any of `separators`, without what is empty: "a" and "b" of "/a//b".
[[nodiscard]] std::vector<std::string_view> PartsBetween(std::string_view separators, std::string_view text);

/// `text` in quotation marks, with \" \\ \n \t \r for what cannot stand in them as it is.
[[nodiscard]] std::string Quoted(std::string_view text);

/// `text` so that it stands for itself between the tags of HTML, SVG and Graphviz labels, and between
/// double quotes in their tags. For attributes of XML that is read again see core/xml/xml_writing.h,
/// which keeps line ends, too.
[[nodiscard]] std::string EscapedMarkup(std::string_view text);

/// `text` with what a terminal would not show but obey, and what is no UTF-8, as "\x1b", but for the characters in `kept`.
/// For what others have written. Threads: any. Allocates.
[[nodiscard]] std::string Printable(std::string_view text, std::string_view kept = {});

/// What things may be called in programs, and what that becomes in the style of another language. Letters and digits are
/// those of ASCII. Threads: any.

/// "wall_follower": lower-case letters, digits and single '_'; begins with a letter, ends with no '_'.
[[nodiscard]] bool IsSnakeCase(std::string_view name) noexcept;
/// "AddNoise Front" → "add_noise_front", "XMLFile" → "xml_file". May be "", or begin with a digit.
[[nodiscard]] std::string SnakeCase(std::string_view name);
/// "wall_follower 2" → "WallFollower2". May be "", or begin with a digit.
[[nodiscard]] std::string CamelCase(std::string_view name);

/// Whether C++20 keeps the word for itself.
[[nodiscard]] bool IsCppKeyword(std::string_view word);

}  // namespace runnel
