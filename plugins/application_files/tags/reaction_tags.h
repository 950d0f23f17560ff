#pragma once

#include "plugins/application_files/build_context.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel::internal {

/// The tags <switch>, <set>, <replace> and <stop>, which are read by the tag that they stand in.
[[nodiscard]] std::vector<XmlTag> ReactionTags();

/// What the tags directly within `xml` say is to be done; mistakes are reported. Paths start at
/// `base`. When connections have been made.
[[nodiscard]] Reaction ReadReaction(XmlElement xml, FrameworkElement& base, BuildContext& context);

}  // namespace runnel::internal
