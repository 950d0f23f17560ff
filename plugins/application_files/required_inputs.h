#pragma once

#include "plugins/application_files/build_context.h"

namespace runnel {

/// Reports each input at or below `application` that has to be connected and is not, unless a
/// connection meant for it failed and that was reported.
void CheckRequiredInputs(FrameworkElement& application, BuildContext& context);

}  // namespace runnel
