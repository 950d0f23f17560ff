#pragma once

#include <string>
#include <string_view>

#include "core/base/error.h"

namespace runnel {

[[nodiscard]] std::string_view WithoutWhitespace(std::string_view text);

/// Walks through a text format. White space before anything that is taken does not count.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : all_(text), rest_(text) {}

  [[nodiscard]] bool AtEnd();
  /// Goes past `character` if it comes next.
  bool Skip(char character);
  /// Letters, digits and underscores.
  std::string_view TakeWord();
  /// Up to the next of , : ] } or the end, without white space at its ends.
  std::string_view TakeToken();
  /// False if no whole text in quotation marks comes next.
  bool TakeQuoted(std::string& text);

  /// "expected `what` before '…'".
  [[nodiscard]] Error Expected(const std::string& what);

 private:
  void SkipWhitespace();

  std::string_view all_;
  std::string_view rest_;
};

}  // namespace runnel
