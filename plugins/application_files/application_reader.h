#pragma once

#include "core/xml/xml_document.h"
#include "plugins/application_files/build_context.h"

namespace runnel {

/// Goes through an application file once, from top to bottom: checks every tag against what the
/// registry knows, and has those that are right handled. Of a tag that is wrong the first mistake is
/// told; it is not handled, and what is in it is checked only.
///
/// What the root tag has made; nullptr if it could not. Errors: all go to the context.
[[nodiscard]] FrameworkElement* ReadApplication(XmlElement root, BuildContext& context);

/// Makes in `group` what the file says that `tag` names as its type. Errors: it cannot be read.
[[nodiscard]] Result<void> ReadGroupType(const XmlAttribute& type, XmlElement tag,
                                         FrameworkElement& group, BuildContext& context);

}  // namespace runnel
