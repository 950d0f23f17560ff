#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.h"

namespace runnel {

/// What ends reading: thrown by the cursor and by those who read with it, caught where reading began.
struct JsonFailure {
  Error error;
};

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
  /// Goes past `character`, or fails: "expected `what``of`, found …".
  void Need(char character, std::string_view what, std::string_view of = {});
  /// Goes past true, false or null if it comes next, and nothing is glued to it.
  bool SkipWord(std::string_view word);
  /// The digits of a number; empty if none comes next.
  [[nodiscard]] std::string_view TakeNumber();
  /// What a text in quotation marks stands for; fails if no whole one comes next, written as JSON wants.
  void TakeString(std::string& text);
  /// Goes past the next value, whatever it is, with at most `depth` lists and objects inside of one another.
  bool SkipValue(int depth);
  /// Whether SkipValue() has failed for want of depth.
  [[nodiscard]] bool is_too_deep() const noexcept { return is_too_deep_; }
  /// Goes past the next value, in a text that has been checked.
  std::string_view TakeValue();

  /// Where it is, in bytes from the beginning.
  [[nodiscard]] std::size_t place() const noexcept { return next_; }
  /// `message` with the line and the column of `place`.
  [[nodiscard]] Error ErrorAt(std::size_t place, std::string message) const;
  /// "expected `what`, found …", of `place`.
  [[nodiscard]] Error ExpectedAt(std::size_t place, std::string_view what) const;
  [[noreturn]] void FailAt(std::size_t place, std::string message, std::string hint = {}) const;
  [[noreturn]] void Fail(std::string message) const { FailAt(next_, std::move(message)); }
  /// Of what comes next.
  [[noreturn]] void FailExpecting(const std::string& what);

 private:
  [[nodiscard]] char At(std::size_t index) const {
    return index < text_.size() ? text_[index] : '\0';
  }
  [[nodiscard]] std::size_t EndOfDigits(std::size_t from) const;
  void TakeEscape(std::string& text);
  unsigned TakeFourDigits();
  void GoPast(int depth);

  std::string_view text_;
  std::size_t next_ = 0;
  bool is_too_deep_ = false;
};

/// Of digits that JsonCursor::TakeNumber() gave. What is beyond the largest double is infinity, as
/// all parsers of JSON have it; what is nearer to 0 than the smallest is 0.
[[nodiscard]] double DoubleOf(std::string_view digits);

/// Of such digits, too. Nothing if it does not fit: not finite in `N`, though a double could say it; or no
/// whole number, or out of range.
template <typename N>
[[nodiscard]] std::optional<N> NumberOf(std::string_view digits) {
  if (digits.empty()) return std::nullopt;
  N number{};
  const auto end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  if (read.ec == std::errc() && read.ptr == end) return number;
  const double wide = DoubleOf(digits);
  if constexpr (std::floating_point<N>) {
    const bool is_too_large = std::isfinite(wide) && std::abs(wide) > std::numeric_limits<N>::max();
    return is_too_large ? std::nullopt : std::optional<N>(static_cast<N>(wide));
  } else {
    // 3.0 and 1e3 are whole numbers, too; so far as a double can tell.
    constexpr double kSurelyWhole = 9007199254740992.0;
    if (read.ec == std::errc::result_out_of_range) return std::nullopt;
    if (!(std::abs(wide) <= kSurelyWhole) || wide != std::trunc(wide)) return std::nullopt;
    const auto whole = static_cast<std::int64_t>(wide);
    return std::in_range<N>(whole) ? std::optional(static_cast<N>(whole)) : std::nullopt;
  }
}

}  // namespace runnel
