#pragma once

#include <iosfwd>

#include "apps/runnel/workplace.h"
#include "core/base/result.h"

namespace runnel::program {

/// Makes a module of the type, writes down its ports and parameters, and deletes it again.
/// Errors: it cannot be made.
Result<void> ListModule(const ModuleType& type, Workplace& workplace, std::ostream& stream);

}  // namespace runnel::program
