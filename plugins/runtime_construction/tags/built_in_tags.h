#pragma once

#include <vector>

#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// The tags that every application file may use, each made in the file named after it.
[[nodiscard]] std::vector<XmlTag> BuiltInTags();

[[nodiscard]] XmlTag ApplicationTag();
[[nodiscard]] XmlTag LoadTag();
[[nodiscard]] XmlTag GroupTag();
[[nodiscard]] XmlTag GroupTypeTag();
[[nodiscard]] XmlTag ModuleTag();
[[nodiscard]] XmlTag PortTag();
[[nodiscard]] XmlTag ConnectTag();
[[nodiscard]] XmlTag ParameterTag();

}  // namespace runnel
