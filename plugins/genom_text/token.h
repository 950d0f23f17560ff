#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/genom_text/place.h"

namespace runnel::genom {

/// A token of the description language.
struct Token {
  enum class Kind { kEnd, kWord, kInteger, kReal, kFixed, kString, kCharacter, kMark, kPragma };

  Kind kind = Kind::kEnd;
  std::string text = {};  ///< a word or mark as written; what a string holds
  std::uint64_t integer = 0;
  double real = 0;
  Place place = {};

  [[nodiscard]] bool IsMark(std::string_view mark) const { return kind == Kind::kMark && text == mark; }
  [[nodiscard]] bool IsWord(std::string_view word) const { return kind == Kind::kWord && text == word; }
  /// As errors name it: "'period'", "the end of the file".
  [[nodiscard]] std::string Name() const;
};

/// Words that mean something everywhere, and can name nothing.
[[nodiscard]] bool IsReserved(std::string_view word);

/// What the preprocessor leaves, as tokens of the language; the last is kEnd. Characters that belong to none are told,
/// and left out.
[[nodiscard]] std::vector<Token> TokensOf(std::vector<TextToken> texts, Problems& problems);

}  // namespace runnel::genom
