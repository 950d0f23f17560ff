#pragma once

#include <memory>

#include "apps/runnel/command_line.h"
#include "plugins/application/application_options.h"
#include "plugins/recording/application_recording.h"
#include "plugins/recording/application_replay.h"
#include "plugins/tracing/application_trace.h"
#include "plugins/viewers/viewers.h"

namespace runnel::program {

/// What the arguments of a run attach to its application.
struct RunExtensions {
  explicit RunExtensions(const RunArguments& arguments);

  /// For loading the application with all of them.
  [[nodiscard]] ApplicationOptions Options(const RunArguments& arguments) const;

  const std::shared_ptr<Viewers> viewers;
  const std::shared_ptr<ApplicationRecording> recording;
  std::shared_ptr<ApplicationTrace> trace;    ///< nullptr: nothing is traced
  std::shared_ptr<ApplicationReplay> replay;  ///< nullptr: nothing is replayed
};

/// A recording that is replayed for viewers alone.
[[nodiscard]] bool IsWithoutApplication(const RunArguments& arguments);

}  // namespace runnel::program
