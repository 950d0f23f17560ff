#pragma once

#include <string>

#include "core/base/error.h"

namespace runnel {

/// From now on what Fast DDS has to say goes to nobody's terminal.
void HearFastLog();
/// `what`, with what Fast DDS has said since it was last asked.
[[nodiscard]] Error FastError(const std::string& what);

}  // namespace runnel
