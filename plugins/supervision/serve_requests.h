#pragma once

#include <functional>
#include <string>

#include "core/element/runtime.h"
#include "plugins/supervision/supervisor.h"

namespace runnel::internal {

using TellAnswer = std::function<void(const std::string& path, std::string what, bool is_failure)>;

/// Carries out what modules ask for (StructureRequest), in the order in which they were made, and answers. A request may
/// delete who has asked. Outside of cycles and without locks.
void ServeRequests(Runtime& runtime, const Supervisor::Perform& perform, const TellAnswer& tell);

}  // namespace runnel::internal
