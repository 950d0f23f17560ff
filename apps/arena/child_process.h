#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "core/base/result.h"

namespace runnel::arena {

/// A program that runs beside this one. It is in a group of its own, so that Ctrl-C reaches only
/// this program, and it dies with this program, however that ends.
///
/// Threads: of the thread that made it; if that ends, so does the child.
class ChildProcess {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  /// `words`: the program's file and its arguments. What it writes goes to the file `output`.
  /// Errors: what the system says.
  static Result<ChildProcess> Start(const std::vector<std::string>& words,
                                    const std::filesystem::path& output);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  /// Kills it if it has not ended.
  ~ChildProcess();

  struct Ending {
    int exit_code = 0;
    int signal = 0;               ///< that ended it; 0: it ended by itself
    double processor_time = 0.0;  ///< s
  };
  /// Nothing as long as it runs. Does not wait.
  std::optional<Ending> Look();
  void Kill();

  [[nodiscard]] WallTime started_at() const { return started_at_; }
  /// Becomes readable when it has ended.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  ChildProcess(pid_t process, int descriptor)
      : process_(process), descriptor_(descriptor), started_at_(std::chrono::steady_clock::now()) {}

  pid_t process_ = -1;
  int descriptor_ = -1;
  WallTime started_at_;
  std::optional<Ending> ending_;
};

}  // namespace runnel::arena
