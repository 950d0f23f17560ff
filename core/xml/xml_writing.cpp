#include "core/xml/xml_writing.h"

namespace runnel {

namespace {

void Write(const NewElement& element, const std::string& margin, const XmlLayout& layout,
           std::string& text) {
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
  std::string text;
  for (const char character : value) {
    switch (character) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '\n':  // readers make spaces of these unless they are written so
        text += "&#10;";
        break;
      case '\r':
        text += "&#13;";
        break;
      case '\t':
        text += "&#9;";
        break;
      default:
        if (character != quote) {
          text += character;
        } else {
          text += quote == '"' ? "&quot;" : "&apos;";
        }
    }
  }
  return text;
}

std::string ElementText(const NewElement& element, std::string_view margin,
                        const XmlLayout& layout) {
  std::string text;
  Write(element, std::string(margin), layout, text);
  return text;
}

}  // namespace runnel
