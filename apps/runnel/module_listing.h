#pragma once

#include <iosfwd>

#include "core/base/result.h"
#include "plugins/application/application_description.h"

namespace runnel::program {

/// Makes a module of the type, writes down its ports and parameters, and deletes it again.
/// Errors: it cannot be made.
Result<void> ListModule(const ModuleType& type, ApplicationDescription& surroundings,
                        std::ostream& stream);

}  // namespace runnel::program
