#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "core/base/error.h"

namespace runnel::internal {

inline bool IsXmlSpace(char character) {
  return character == ' ' || character == '\t' || character == '\n' || character == '\r';
}

/// `text` without white space at either end.
inline std::string_view Trimmed(std::string_view text) {
  while (!text.empty() && IsXmlSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsXmlSpace(text.back())) text.remove_suffix(1);
  return text;
}

inline bool IsXmlNameStart(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         character == ':' || character == '_' || static_cast<unsigned char>(character) >= 128;
}
inline bool IsXmlNameCharacter(char character) {
  return IsXmlNameStart(character) || (character >= '0' && character <= '9') || character == '.' ||
         character == '-';
}

/// Walks through a text and knows at which line and column it is. The byte order mark is no column.
class TextCursor {
 public:
  TextCursor(std::string_view text, const std::string& file_name)
      : file_name_(&file_name), size_(text.size()), rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (Sees(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] SourcePosition position() const { return {*file_name_, line_, column_}; }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// In bytes from the beginning.
  [[nodiscard]] std::size_t offset() const { return size_ - rest_.size(); }
  /// '\0' at the end.
  [[nodiscard]] char next() const { return rest_.empty() ? '\0' : rest_.front(); }
  [[nodiscard]] bool Sees(std::string_view expected) const { return rest_.starts_with(expected); }

  /// Steps over `count` bytes and returns them. Precondition: as many are left.
  std::string_view Take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    for (const char character : taken) {
      if (character == '\n') {
        ++line_;
        column_ = 1;
      } else if ((static_cast<unsigned char>(character) & 0xC0U) != 0x80U) {
        ++column_;  // a byte that continues a UTF-8 character is not counted
      }
    }
    rest_.remove_prefix(count);
    return taken;
  }
  template <typename Predicate>
  std::string_view TakeWhile(Predicate is_taken) {
    const auto end = std::ranges::find_if_not(rest_, is_taken);
    return Take(static_cast<std::size_t>(end - rest_.begin()));
  }
  std::string_view TakeName() {
    return IsXmlNameStart(next()) ? TakeWhile(IsXmlNameCharacter) : std::string_view();
  }
  std::string_view TakeSpace() { return TakeWhile(IsXmlSpace); }

 private:
  const std::string* file_name_;
  std::size_t size_;
  std::string_view rest_;
  int line_ = 1;
  int column_ = 1;
};

}  // namespace runnel::internal
