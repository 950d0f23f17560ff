#pragma once

#include <memory>
#include <string>

#include "apps/runnel/command_line.h"
#include "core/base/result.h"
#include "plugins/recording/recorder.h"

namespace runnel {
class Scheduler;
}

namespace runnel::program {

/// What a recording says of the application that these arguments have built.
[[nodiscard]] RecordedApplication AboutApplication(const ApplicationArguments& arguments,
                                                   const std::string& name);

/// The recording that the user wants of a run; nullptr if none. Errors: see Recorder::Start().
Result<std::unique_ptr<Recorder>> StartRecording(const RecordArguments& wish,
                                                 const RecordedApplication& about, Runtime& runtime,
                                                 Scheduler& scheduler);

/// "recorded 1234 values of 5 ports, 1.2 MB, to run.mcap", with what was lost.
[[nodiscard]] std::string RecordingText(const std::string& file, const RecordingStatus& status);

/// "1.2 MB".
[[nodiscard]] std::string SizeText(std::uint64_t bytes);

}  // namespace runnel::program
