#pragma once

#include <string>

#include "apps/runnel/workplace.h"
#include "core/base/result.h"

namespace runnel::program {

/// Makes ports for all that a recording has, with the paths that were recorded, so that it can be replayed
/// without the application that it is of: `echo`, viewers and recorders find them. Types come from the
/// plugins that can be found; what is of none of them is left out, and said on stderr. Returns the element
/// that stands for the application; `before_ready` sees it before anything is ready.
/// Errors: no recording; none of its types is known.
Result<FrameworkElement*> MakeRecordedApplication(const std::string& file, Workplace& workplace,
                                                  const Workplace::BeforeReady& before_ready);

}  // namespace runnel::program
