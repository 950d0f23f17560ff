#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

class TypeInfo;

/// What a text says of a value, taken apart before anybody looks at the value's type: the text format (text_format.h)
/// and JSON (plugins/values) both become tokens, and one reader sets values from either.
///
/// A list or a structure is followed by what is inside; in a structure, a text with the field's name stands
/// before each value.
struct ValueToken {
  enum class Kind { kWord, kText, kList, kStructure };

  Kind kind;
  std::string text;        ///< a word as it stands: true, 3.5, left; what a text in quotation marks stands for
  std::size_t count = 0;   ///< of elements, or of names and values together
  std::size_t extent = 1;  ///< how many tokens these are, with itself

  /// The first inside, if there is one.
  [[nodiscard]] const ValueToken* First() const { return this + 1; }
  /// The one behind this and all that is inside, if there is one.
  [[nodiscard]] const ValueToken* Next() const { return this + extent; }
};

/// The tokens of one text, which those who read it add from its begin to its end.
class ValueTokens {
 public:
  static constexpr int kDeepest = 100;

  explicit ValueTokens(int deepest = kDeepest) : deepest_(deepest) {}

  /// A word, a text or the name of a field.
  void Add(ValueToken::Kind kind, std::string text);
  /// A list or a structure; what is added until End() is inside. Errors: there are too many inside of one another.
  Result<void> Begin(ValueToken::Kind kind);
  void End();

  /// Precondition: something has been added.
  [[nodiscard]] const ValueToken& root() const { return tokens_.front(); }

 private:
  const int deepest_;
  std::vector<ValueToken> tokens_;
  std::vector<std::size_t> open_;
};

/// The tokens of a text in the format of text_format.h. Errors: what is wrong with its form.
[[nodiscard]] Result<ValueTokens> TokensOf(std::string_view text);

/// Sets a leaf, of which each format has its own idea.
using LeafReader = Result<void> (*)(const TypeInfo& type, const ValueToken& token, void* value);

/// Sets `value` to what the token says. Fields that are not named stay as they are; elements of lists begin as the type
/// makes them.
/// Errors: what is wrong and of which field ("points[2].x"), with the nearest name that would have been
/// right. The value may then be half set. A list that takes more than 256 MiB is refused, as a few bytes of text
/// can promise much.
[[nodiscard]] Result<void> SetFromTokens(const TypeInfo& type, const ValueToken& token, LeafReader read_leaf,
                                         void* value);

/// "expected a number, found 'a'".
[[nodiscard]] Error Expected(std::string_view what, const ValueToken& found);

}  // namespace runnel
