#include "core/xml/xml_writing.h"

#include <array>

namespace runnel {

namespace {

void Write(const NewElement& element, const std::string& margin, const XmlLayout& layout, std::string& text) {
  if (element.after_blank_line) text += layout.line_end;
  text += margin + "<" + element.name;
  for (const auto& [name, value] : element.attributes) {
    text += " " + name + "=\"" + EscapedAttribute(value) + "\"";
  }
  if (!element.text.empty()) {
    text += ">" + EscapedAttribute(element.text) + "</" + element.name + ">" + layout.line_end;
    return;
  }
  if (element.children.empty()) {
    text += "/>" + layout.line_end;
    return;
  }
  text += ">" + layout.line_end;
  for (const NewElement& child : element.children) {
    Write(child, margin + layout.indent, layout, text);
  }
  text += margin + "</" + element.name + ">" + layout.line_end;
}

}  // namespace

std::string EscapedAttribute(std::string_view value, char quote) {
  constexpr std::string_view kMeant = "&<\n\r\t";  // of the last three readers make spaces unless they are written so
  constexpr std::array kNames{"&amp;", "&lt;", "&#10;", "&#13;", "&#9;"};
  std::string text;
  for (const char character : value) {
    const std::size_t meant = kMeant.find(character);
    if (meant != std::string_view::npos) {
      text += kNames[meant];
    } else if (character != quote) {
      text += character;
    } else {
      text += quote == '"' ? "&quot;" : "&apos;";
    }
  }
  return text;
}

std::string ElementText(const NewElement& element, std::string_view margin, const XmlLayout& layout) {
  std::string text;
  Write(element, std::string(margin), layout, text);
  return text;
}

}  // namespace runnel
