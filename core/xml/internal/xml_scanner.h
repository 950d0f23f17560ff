#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/xml/xml_document.h"

namespace runnel::internal {

/// A place in a text, both counted from 1; columns count characters, not bytes.
struct TextPlace {
  int line = 1;
  int column = 1;

  friend bool operator==(TextPlace, TextPlace) = default;
};

/// Owns its children by pointer, so that nodes stay where they are while the tree grows and moves.
struct XmlNode {
  const std::string* file_name = nullptr;  // the root's own_file_name
  std::string own_file_name;               // at the root only
  std::string name;
  TextPlace place;
  ElementSpans spans;
  std::string text;
  TextPlace text_place;  // of the first text directly between the tags; `place` if there is none
  std::vector<XmlAttribute> attributes;
  XmlNode* parent = nullptr;
  std::vector<std::unique_ptr<XmlNode>> owned_children;
  std::vector<XmlElement> children;
};

/// The elements of an XML text with all their places, but without texts and the values of attributes. `begin`: how
/// many bytes stand before the text in its file.
///
/// tinyxml2 knows the line of an error and of an element but no column, and lets much pass that is
/// not XML. So this goes over the text first: it finds all places, and refuses with line and column
/// whatever is not well-formed.
Result<std::unique_ptr<XmlNode>> ScanXml(std::string_view text, const std::string& file_name, std::size_t begin);

inline bool IsXmlSpace(char character) {
  return character == ' ' || character == '\t' || character == '\n' || character == '\r';
}

/// `text` without the white space at its ends.
inline std::string_view WithoutXmlSpace(std::string_view text) {
  while (!text.empty() && IsXmlSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsXmlSpace(text.back())) text.remove_suffix(1);
  return text;
}
// The same characters as in tinyxml2, so that both find the same names.
inline bool IsXmlNameStart(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') || character == ':' ||
         character == '_' || static_cast<unsigned char>(character) >= 128;
}
inline bool IsXmlNameCharacter(char character) {
  return IsXmlNameStart(character) || (character >= '0' && character <= '9') || character == '.' || character == '-';
}

/// Walks through a text and knows at which line and column it is.
class TextCursor {
 public:
  /// `begin`: how many bytes stand before the text in its file.
  explicit TextCursor(std::string_view text, std::size_t begin = 0) : end_(begin + text.size()), rest_(text) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] TextPlace place() const { return place_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// In bytes from the beginning of the file.
  [[nodiscard]] std::size_t offset() const { return end_ - rest_.size(); }
  /// '\0' at the end.
  [[nodiscard]] char next() const { return rest_.empty() ? '\0' : rest_.front(); }
  [[nodiscard]] bool Sees(std::string_view expected) const { return rest_.starts_with(expected); }

  /// Steps over `count` bytes and returns them. Precondition: as many are left.
  std::string_view Take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    for (const char character : taken) {
      if (character == '\n') {
        ++place_.line;
        place_.column = 1;
      } else if ((static_cast<unsigned char>(character) & 0xC0U) != 0x80U) {
        ++place_.column;  // a byte that continues a UTF-8 character is not counted
      }
    }
    rest_.remove_prefix(count);
    return taken;
  }

  template <typename Predicate>
  std::string_view TakeWhile(Predicate predicate) {
    std::size_t count = 0;
    while (count < rest_.size() && predicate(rest_[count])) ++count;
    return Take(count);
  }

  std::string_view TakeName() { return IsXmlNameStart(next()) ? TakeWhile(IsXmlNameCharacter) : std::string_view(); }
  /// True if there was any.
  bool SkipSpace() { return !TakeWhile(IsXmlSpace).empty(); }

 private:
  std::size_t end_;
  std::string_view rest_;
  TextPlace place_;
};

}  // namespace runnel::internal
