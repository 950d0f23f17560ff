#pragma once

#include <string>
#include <vector>

#include "core/element/framework_element.h"
#include "core/xml/xml_document.h"

namespace runnel {

/// A path to an element, as it stands in an application file.
struct PathUse {
  FrameworkElement& base;  ///< where relative paths begin
  std::string path;
  SourcePosition position;
};

/// The one path in an attribute.
[[nodiscard]] PathUse PathIn(const XmlAttribute& attribute, FrameworkElement& base);
/// The paths in an attribute that holds a list, each with its own place.
[[nodiscard]] std::vector<PathUse> PathsIn(const XmlAttribute& attribute, FrameworkElement& base);

}  // namespace runnel
