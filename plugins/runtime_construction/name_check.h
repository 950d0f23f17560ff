#pragma once

#include <string>
#include <string_view>

#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// For tags that make an element called like their required attribute "name" below `where`: whether
/// the name is still free there. False after reporting.
[[nodiscard]] bool CheckNameIsFree(const TagUse& use, const FrameworkElement& where);

/// For the same tags: the name if it is free there. If not, a stand-in after reporting: nothing of
/// the tree stays, and what is within the tag can be looked at.
[[nodiscard]] std::string FreeName(const TagUse& use, const FrameworkElement& where);

/// What those tags are called that have no name, or a wrong one. FreeName() makes it unique.
inline constexpr const char* kStandInName = "?";
[[nodiscard]] bool IsStandIn(std::string_view name);

}  // namespace runnel
