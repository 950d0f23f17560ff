#include "apps/runnel/trace_run.h"

#include <iostream>

#include "apps/runnel/print_error.h"
#include "core/base/diagnostics.h"

namespace runnel::program {

ExitCode FinishTrace(ApplicationTrace& trace, const RunArguments& arguments, ExitCode code) {
  const auto finished = trace.Finish();
  if (!finished) {
    PrintError(finished.error());
    return code == ExitCode::kDone ? ExitCode::kRunFailed : code;
  }
  if (!arguments.quiet) {
    std::cout << "traced " << finished->events << " events to " << arguments.trace << std::endl;
  }
  const auto warn = [&](std::uint64_t events, const char* why) {
    if (events == 0) return;
    Diagnostics diagnostics;
    diagnostics.AddWarning({.message = std::to_string(events) + " events are not in it, as " + why,
                            .position = {arguments.trace}});
    std::cerr << diagnostics.ToString();
  };
  warn(finished->lost, "they came faster than they could be written down");
  warn(finished->left_out, "it is as long as a trace may be");
  return code;
}

}  // namespace runnel::program
