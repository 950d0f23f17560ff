#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/diagnostics.h"
#include "core/base/result.h"
#include "core/element/robot_stop.h"
#include "plugins/command_service/application_log.h"

namespace runnel {

/// Keeps the STOP of an application across its processes: while STOP is in force there is a file of it in the folder of the
/// control sockets. It is named after the application's file and name, so two applications of one name have two.
///
/// Ownership:  the STOP and the log outlive it.
/// Threads:    made by one; who presses or releases writes the file, after that is in force.
class StopFile {
 public:
  /// Presses STOP if a process before this one left it in force, and says so as a warning, or, if `clears`, forgets it.
  /// Follows STOP from then on. Warnings: there can be no such folder. Errors: others can write into the folder, so whether
  /// STOP was in force cannot be known; with `clears`, a warning.
  static Result<std::unique_ptr<StopFile>> Follow(RobotStop& stop, ApplicationLog& log,
                                                  const std::filesystem::path& application_file,
                                                  const std::string& name, bool clears,
                                                  Diagnostics& diagnostics);

  StopFile(RobotStop& stop, ApplicationLog& log, std::filesystem::path file);
  StopFile(const StopFile&) = delete;
  StopFile& operator=(const StopFile&) = delete;

 private:
  void Note() noexcept;

  RobotStop& stop_;
  ApplicationLog& log_;
  const std::filesystem::path file_;
  std::mutex writing_;
  const StopSignal::Subscription changes_;
};

}  // namespace runnel
