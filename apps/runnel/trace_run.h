#pragma once

#include "apps/runnel/command_line.h"
#include "apps/runnel/exit_code.h"
#include "plugins/tracing/application_trace.h"

namespace runnel::program {

/// After the last cycle: says what the trace has come to. Returns `code`, how the run ended, unless the trace
/// could not be written.
[[nodiscard]] ExitCode FinishTrace(ApplicationTrace& trace, const RunArguments& arguments,
                                   ExitCode code);

}  // namespace runnel::program
