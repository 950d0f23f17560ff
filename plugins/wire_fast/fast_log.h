#pragma once

#include <string>

#include "core/base/error.h"

namespace runnel {

/// From now on what Fast DDS has to say goes to nobody's terminal.
void HearFastLog();
/// And why others are not let in is kept, too.
void HearFastSecurity();
/// Why somebody has not been let in, as Fast DDS has said since this was last asked; "" if it has not.
[[nodiscard]] std::string TakeFastRefusal();
/// `what`, with what Fast DDS has said since it was last asked.
[[nodiscard]] Error FastError(const std::string& what);

}  // namespace runnel
