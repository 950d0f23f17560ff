#pragma once

#include <string>
#include <string_view>

#include "core/element/annotation.h"
#include "plugins/runtime_construction/xml_tag.h"

namespace runnel {

/// For tags that make an element called like their required attribute "name" below `where`: whether
/// the name is still free there. False after reporting, or if a stand-in has it.
[[nodiscard]] bool CheckNameIsFree(const TagUse& use, const FrameworkElement& where);

/// For the same tags: the name if it is free there. If not, a stand-in after reporting: nothing of
/// the tree stays, and what is within the tag can be looked at.
[[nodiscard]] std::string FreeName(const TagUse& use, const FrameworkElement& where);

/// Kept with elements whose tag has no name, or a wrong one, or one that is taken: nobody can mean them.
struct StandIn final : Annotation {};
[[nodiscard]] bool IsStandIn(const FrameworkElement& element);
/// Notes it of what has been made for the tag, if it is not called as the tag says.
void MarkIfStandIn(FrameworkElement& made, const TagUse& use);

}  // namespace runnel
