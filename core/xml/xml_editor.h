#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/xml/xml_document.h"
#include "core/xml/xml_writing.h"

namespace runnel {

/// Changes an XML text by its elements. What is not named stays as it is, byte for byte: comments,
/// order, indentation, quotes, line ends. What is new follows the manner of the file.
///
/// Lifetime: within that of the document and of the text.
class XmlEditor {
 public:
  /// `document` has been read from `text`.
  XmlEditor(const XmlDocument& document, std::string_view text);

  void SetAttribute(XmlElement element, std::string_view name, std::string_view value);
  /// Nothing if there is none.
  void RemoveAttribute(XmlElement element, std::string_view name);
  /// What stands between the tags of an element that has no children; comments stay.
  void SetText(XmlElement element, std::string_view text);
  /// Takes words out of an attribute that is a list of them. `words` counts from 0.
  void RemoveWords(const XmlAttribute& list, const std::set<std::size_t>& words);
  /// With its line, if nothing else stands there.
  void Remove(XmlElement element);
  /// Before the closing tag of `parent`, each on lines of its own.
  void Append(XmlElement parent, NewElement element);
  /// On the line after that of `sibling`.
  void InsertAfter(XmlElement sibling, const NewElement& element);
  /// On the line after the start tag of `parent`.
  void InsertFirst(XmlElement parent, const NewElement& element);

  [[nodiscard]] bool has_changes() const noexcept { return !edits_.empty() || !appended_.empty(); }
  /// The changed text.
  [[nodiscard]] std::string Finish();

 private:
  // What the line of `place` begins with, up to the first that is no whitespace.
  [[nodiscard]] std::string MarginAt(std::size_t place) const;
  [[nodiscard]] std::string MarginInside(XmlElement parent) const;
  [[nodiscard]] std::size_t SkipWhitespaceBack(std::size_t place) const;
  [[nodiscard]] std::size_t SkipWhitespace(std::size_t place) const;
  [[nodiscard]] bool BeginsLine(std::size_t place) const;
  // Where the next line begins, if but whitespace stands before it; else `place`.
  [[nodiscard]] std::size_t NextLine(std::size_t place) const;
  // Below the line of `place`, or, if more stands there, between.
  void InsertLines(std::size_t place, std::string lines);
  void WriteAppended(XmlElement parent, const std::vector<NewElement>& elements);

  // Changes of the text that leave all the rest of it as it is. Places are those of the text before any change;
  // what is put at one place goes there in the order of the calls.
  void Insert(std::size_t place, std::string text) { Replace({place, place}, std::move(text)); }
  void Cut(TextSpan span) { Replace(span, ""); }
  // Of two that overlap, the later in the text gives way; what both cut is cut.
  void Replace(TextSpan span, std::string text) { edits_.push_back({span, std::move(text)}); }

  struct Edit {
    TextSpan span;
    std::string text;
  };
  std::string_view text_;
  XmlLayout layout_;
  std::vector<Edit> edits_;
  struct Appended {
    XmlElement parent;
    std::vector<NewElement> elements;
  };
  std::map<std::size_t, Appended> appended_;  // by the place of the parent
};

}  // namespace runnel
