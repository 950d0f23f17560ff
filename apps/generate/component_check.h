#pragma once

#include <string>

#include "core/base/error.h"

namespace runnel {

/// Has Spin look at models of the components (template `promela`) for what their threads can come to: a standstill, two
/// codels at once that conflict, an interrupted activity that does not end. Errors tell what happens before, in words of
/// the component; warnings, that it could not be decided. `model` is the description as JSON. Takes seconds.
void CheckBySpin(const std::string& model, Diagnostics& diagnostics);

}  // namespace runnel
