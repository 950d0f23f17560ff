#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// Walks through JSON text (RFC 8259, strictly: no comments, no commas too many, no other numbers).
/// White space before anything that is taken does not count. Never looks beyond the text's end.
class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text) : text_(text) {}

  void SkipWhitespace();
  /// What comes next; '\0' at the end.
  [[nodiscard]] char Peek();
  [[nodiscard]] bool AtEnd();
  /// Goes past `character` if it comes next.
  bool Skip(char character);
  /// Goes past true, false or null if it comes next, and nothing is glued to it.
  bool SkipWord(std::string_view word);
  /// The digits of a number; empty if none comes next.
  [[nodiscard]] std::string_view TakeNumber();
  /// What a text in quotation marks stands for. Errors: no whole text comes next, or it is not
  /// written as JSON wants.
  Result<void> TakeString(std::string& text);
  /// Goes past the next value, whatever it is, with at most `depth` lists and objects inside of one another.
  bool SkipValue(int depth);
  /// Whether SkipValue() has failed for want of depth.
  [[nodiscard]] bool is_too_deep() const noexcept { return is_too_deep_; }
  /// Goes past the next value, in a text that has been checked.
  std::string_view TakeValue();

  /// `message` with the line and the column of what comes next.
  [[nodiscard]] Error ErrorHere(std::string message);
  /// "expected `what`, found …".
  [[nodiscard]] Error Expected(const std::string& what);

 private:
  [[nodiscard]] char At(std::size_t index) const {
    return index < text_.size() ? text_[index] : '\0';
  }
  [[nodiscard]] std::size_t EndOfDigits(std::size_t from) const;
  Result<void> TakeEscape(std::string& text);
  Result<unsigned> TakeFourDigits();

  std::string_view text_;
  std::size_t next_ = 0;
  bool is_too_deep_ = false;
};

}  // namespace runnel
