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

}  // namespace runnel::internal
