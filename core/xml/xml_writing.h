#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace runnel {

/// An element that is to be written.
struct NewElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::vector<NewElement> children = {};
  bool after_blank_line = false;
  std::string text = {};  ///< instead of children
};

/// How elements are laid out: each on lines of its own.
struct XmlLayout {
  std::string indent = "  ";  ///< for each level
  std::string line_end = "\n";
};

/// `value` as it stands between quotes: with entities for what would end it or be read otherwise.
[[nodiscard]] std::string EscapedAttribute(std::string_view value, char quote = '"');

/// The element and all in it, `margin` before each line and a line end behind each.
[[nodiscard]] std::string ElementText(const NewElement& element, std::string_view margin = "",
                                      const XmlLayout& layout = {});

}  // namespace runnel
