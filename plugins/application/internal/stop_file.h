#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_descriptor.h"
#include "core/base/lookout.h"
#include "core/base/result.h"
#include "core/element/robot_stop.h"
#include "plugins/command_service/application_log.h"

namespace runnel {

/// Keeps the STOP of an application across its processes: while STOP is in force there is a file of this process in the folder
/// of the control sockets, named after the application's file and name, and after the process. Who has it holds a lock
/// on it, which ends with the process. A file that nobody holds was left by a process that has ended: the next one takes it over
/// when it begins, and then its own release removes it. What others hold then, or leave later, is not its, and stays.
///
/// Ownership:  the STOP and the log outlive it.
/// Threads:    made by one; one of its own writes, so no disk delays who presses. IsKept() by any. A process that is killed
///             before that thread has written leaves no STOP.
class StopFile {
 public:
  /// Presses STOP if another process has left it in force, or has it in force now, and says so as a warning; if `clears`,
  /// it is not pressed, and what was left is forgotten.
  /// Follows STOP from then on. Warnings: there can be no such folder. Errors: others can write into the folder, or it cannot be listed, so whether
  /// STOP was in force cannot be known; with `clears`, a warning.
  static Result<std::unique_ptr<StopFile>> Follow(RobotStop& stop, ApplicationLog& log,
                                                  const std::filesystem::path& application_file,
                                                  const std::string& name, bool clears, Diagnostics& diagnostics);

  /// `name`: how the names of all files of the application begin. `left`: those that it takes over.
  StopFile(RobotStop& stop, ApplicationLog& log, std::filesystem::path folder, const std::string& name,
           std::vector<std::filesystem::path> left = {});
  ~StopFile();

  /// Whether the last press or release has been written. Waits for that for 50 ms at most.
  [[nodiscard]] bool IsKept();

 private:
  Result<void> Follow(const RobotStop::State& state);
  Result<void> Hold(const std::string& text);
  void Write() noexcept;

  RobotStop& stop_;
  ApplicationLog& log_;
  const std::filesystem::path folder_;
  const std::filesystem::path file_;         // of this process
  std::vector<std::filesystem::path> left_;  // taken over, and there perhaps; of the thread that writes
  FileDescriptor held_;                      // the file, while STOP is in force; of the thread that writes
  std::mutex mutex_;
  std::condition_variable has_written_;
  std::uint64_t written_ = 0;  // guarded by mutex_: which change of the STOP
  bool has_failed_ = false;    // guarded by mutex_
  std::optional<Lookout> lookout_;
  StopSignal::Subscription changes_;
};

}  // namespace runnel
