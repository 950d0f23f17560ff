#pragma once

#include "plugins/inspector/internal/requests.h"

namespace runnel::internal {

/// How values of one port could be passed on to another: parts and conversions. Waits for the structure lock.
[[nodiscard]] std::string FindConversions(Inspection& inspection, const ViewerMessage& message);

}  // namespace runnel::internal
