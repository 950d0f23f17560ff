#pragma once

#include <optional>
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
};

struct AttributePlace {
  std::string_view name;
  TextPlace place;
  TextPlace value_place;
  TextSpan span = {};
  TextSpan value_span = {};
};

struct StartTag {
  std::string_view name;
  TextPlace place;
  std::vector<AttributePlace> attributes;
  std::optional<TextPlace> text_place = {};  ///< of the first text directly between the tags
  TextSpan span = {};
  TextSpan end_tag = {};  ///< empty, behind `span`, if the element is
};

/// The start tags of an XML text in the order of the text; the names refer to `text`.
///
/// tinyxml2 knows the line of an error and of an element but no column, and lets much pass that is
/// not XML. So this goes over the text first: it finds all places, and refuses with line and column
/// whatever is not well-formed.
Result<std::vector<StartTag>> FindStartTags(std::string_view text, const std::string& file_name);

}  // namespace runnel::internal
