#pragma once

#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// For tags that make an element called like their required attribute "name" below `where`: whether
/// the name is still free there. False after reporting.
[[nodiscard]] bool CheckNameIsFree(const TagUse& use, const FrameworkElement& where);

}  // namespace runnel
