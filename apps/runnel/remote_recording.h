#pragma once

#include <string>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "plugins/control/control_client.h"
#include "plugins/control/recording_hook.h"
#include "plugins/control/request.h"
#include "plugins/recording/recorder.h"

namespace runnel {
class Scheduler;
}

namespace runnel::program {

/// By which other processes record this application. All of it outlives the hook.
[[nodiscard]] RecordingHook RecordingHookOf(const RecordedApplication& about, Runtime& runtime,
                                            Scheduler& scheduler);

/// The other end: has the application record, shows on a terminal how it goes, and says what there is when
/// it has ended, also by Ctrl-C. Returns the exit code. Errors: the connection is lost.
Result<int> AskToRecord(ControlClient& client, const Request& request, const std::string& file);

}  // namespace runnel::program
