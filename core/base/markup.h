#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// `text` so that it stands for itself between the tags of HTML, SVG and Graphviz labels, and between
/// double quotes in their tags. For attributes of XML that is read again see core/xml/xml_writing.h,
/// which keeps line ends, too.
[[nodiscard]] std::string EscapedMarkup(std::string_view text);

}  // namespace runnel
