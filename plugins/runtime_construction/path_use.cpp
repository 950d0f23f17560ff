#include "plugins/runtime_construction/path_use.h"

#include <algorithm>
#include <string_view>

#include "plugins/runtime_construction/attribute_rule.h"

namespace runnel {

namespace {

// Columns count characters: the bytes of UTF-8 that begin one.
int CountCharacters(std::string_view text) {
  return static_cast<int>(
      std::ranges::count_if(text, [](char byte) { return (byte & 0xc0) != 0x80; }));
}

}  // namespace

PathUse PathIn(const XmlAttribute& attribute, FrameworkElement& base) {
  return {base, attribute.value, attribute.value_position};
}

std::vector<PathUse> PathsIn(const XmlAttribute& attribute, FrameworkElement& base) {
  const std::string_view value = attribute.value;
  std::vector<PathUse> paths;
  std::size_t from = 0;
  for (std::string& word : SplitPaths(value)) {
    const std::size_t begin = value.find(word, from);
    from = begin + word.size();
    const std::string_view before = value.substr(0, begin);
    SourcePosition position = attribute.value_position;
    // An attribute may go over several lines.
    position.line += static_cast<int>(std::ranges::count(before, '\n'));
    const std::size_t line_end = before.rfind('\n');
    if (line_end == std::string_view::npos) {
      position.column += CountCharacters(before);
    } else {
      position.column = 1 + CountCharacters(before.substr(line_end + 1));
    }
    paths.push_back({base, std::move(word), std::move(position)});
  }
  return paths;
}

}  // namespace runnel
