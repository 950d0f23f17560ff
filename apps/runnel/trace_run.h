#pragma once

#include <memory>

#include "apps/runnel/command_line.h"
#include "apps/runnel/exit_code.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/tracing/trace_recorder.h"

namespace runnel::program {

/// Traces what a scheduler with these options will do, if the arguments say so; else nullptr.
/// Errors: the file cannot be made.
[[nodiscard]] Result<std::unique_ptr<TraceRecorder>> StartTrace(const RunArguments& arguments,
                                                                FrameworkElement& application,
                                                                SchedulerOptions& options);

/// After the last cycle: says what the trace has come to. Returns `code`, how the run ended, unless the trace
/// could not be written.
[[nodiscard]] ExitCode FinishTrace(TraceRecorder& recorder, const RunArguments& arguments,
                                   ExitCode code);

}  // namespace runnel::program
