#pragma once

#include <string>

#include "core/xml/xml_document.h"

namespace runnel::internal {

/// The first attribute that says what `tag` is called; "" if there is none.
[[nodiscard]] inline std::string NameOf(XmlElement tag) {
  const XmlAttribute* const name = tag.Attribute("name");
  return name != nullptr ? name->value : "";
}

}  // namespace runnel::internal
