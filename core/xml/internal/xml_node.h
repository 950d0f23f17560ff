#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/xml/xml_document.h"

namespace runnel::internal {

/// Owns its children by pointer, so that nodes stay where they are while the tree grows and moves.
struct XmlNode {
  std::string name;
  SourcePosition position;
  ElementSpans spans;
  std::string text;
  SourcePosition text_position;
  std::vector<XmlAttribute> attributes;
  const XmlNode* parent = nullptr;
  std::vector<std::unique_ptr<XmlNode>> owned_children;
  std::vector<XmlElement> children;
};

/// The root of what an XML text says. Errors: whatever is not well-formed, with line and column.
Result<std::unique_ptr<XmlNode>> ReadTree(std::string_view text, const std::string& file_name);

}  // namespace runnel::internal
