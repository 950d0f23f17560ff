#pragma once

#include "core/element/framework_element.h"
#include "plugins/application_files/xml_tag.h"

namespace runnel::internal {

/// Sets the parameter that a <parameter> names, of `module`, to the strongest of what the tag says. `scope`: what `from`
/// is looked up from, upwards. All that it says is checked, so that a mistake shows even when it is overridden.
/// `may_wait`: a parameter that stands for what is not there yet may be set once it is.
void SetValue(const TagUse& use, const FrameworkElement& module, const FrameworkElement& scope,
              bool may_wait = true);

}  // namespace runnel::internal
