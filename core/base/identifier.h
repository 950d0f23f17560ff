#pragma once

#include <string>
#include <string_view>

namespace runnel {

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
