#pragma once

#include <string>
#include <vector>

#include "core/xml/xml_writing.h"
#include "plugins/application_files/saving/saving.h"

namespace runnel::internal {

// The tags that give again what is in the tree, as if no file had been there before.

/// `saved` as an element, with all that is in it. `about`: the element that errors name.
[[nodiscard]] NewElement ElementOf(const XmlTag& tag, const SavedTag& saved,
                                   const FrameworkElement& about, Saving& saving);

/// The tags that may stand in another, in the order of XmlTag::place.
[[nodiscard]] std::vector<const XmlTag*> TagsWithin(std::string_view tag, const Saving& saving);

}  // namespace runnel::internal
