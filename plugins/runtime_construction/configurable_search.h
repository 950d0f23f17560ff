#pragma once

#include <string>
#include <vector>

#include "core/port/path_search.h"
#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/path_use.h"

namespace runnel {

/// What a path names. "guard/speed" is short for "guard/parameter/speed". Empty after reporting
/// what is not there or cannot be set.
[[nodiscard]] ConfigurableElement SearchConfigurable(const PathUse& use, BuildContext& context);

}  // namespace runnel
