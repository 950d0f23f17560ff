#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "plugins/application_files/saving/application_saver.h"
#include "plugins/command_service/command_service.h"
#include "plugins/scheduling/scheduler.h"

/// What a save replaces, and what the end of a run takes along. Under the structure lock, but for what reads the disk.
namespace runnel::internal {

/// What would be lost if something else were written there; nothing if there is no such file. Without the lock: a disk may take
/// its time.
[[nodiscard]] std::optional<Error> WhatIsLost(const std::filesystem::path& file);
/// Whether the application came from it, or is saved there without a name.
[[nodiscard]] bool IsOwnFile(const FrameworkElement& application, const std::filesystem::path& file);
/// What SaveApplication() with the same arguments would write; whether the text would load is not tried.
[[nodiscard]] Result<ServiceHooks::SaveDifference> TextToSave(FrameworkElement& application, const SaveTools& tools,
                                                              const std::filesystem::path& chosen);
/// Completes it with what would be replaced. Without the lock. Errors: what is there is no file, or cannot be read.
[[nodiscard]] Result<void> ReadBefore(ServiceHooks::SaveDifference& difference);

/// What is set now and no file keeps, as a sentence; "" for nothing. `has_stop`: whoever comes next has that.
[[nodiscard]] std::string WhatPasses(FrameworkElement& application, const Scheduler& scheduler, bool has_stop);
/// That, and whether anything has been changed since the application's file was read or saved, each as a line. What stands
/// on the disk by now is not looked at.
[[nodiscard]] std::string WhatEnds(FrameworkElement& application, const Scheduler& scheduler, const SaveTools& tools,
                                   bool has_stop);

}  // namespace runnel::internal
