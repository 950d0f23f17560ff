#pragma once

#include <string>

#include "core/base/result.h"
#include "core/port/typed_ports.h"

namespace runnel::flow {

/// What makes ports for values of the type called `name`, as in `<port type="…">`, for modules that take any. Errors: no
/// such type, with the nearest; none that a port of a loaded plugin has. Locks.
[[nodiscard]] Result<const TypedPorts*> FindPortsByName(const std::string& name);

}  // namespace runnel::flow
