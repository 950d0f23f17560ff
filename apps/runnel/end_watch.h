#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

#include "plugins/application/application.h"
#include "plugins/application/application_extension.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::program {

/// While it lives, Ctrl-C, SIGTERM and SIGHUP ask the scheduler to stop, so that the run ends in order. A second one,
/// of whichever kind, is left to who asks for it (EndWatch), a third ends the program at once. What the caller of the
/// program has it ignore (nohup) stays ignored.
///
/// One at a time.
class EndSignal {
 public:
  /// Those that end a run.
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

  explicit EndSignal(Scheduler& scheduler);
  ~EndSignal();
  EndSignal(const EndSignal&) = delete;
  EndSignal& operator=(const EndSignal&) = delete;

  /// While the newest of them has lived; also after it has gone, since what comes then ends the program at once.
  [[nodiscard]] static bool has_come() noexcept;
  /// A second one has.
  [[nodiscard]] static bool has_come_again() noexcept;

 private:
  std::array<struct sigaction, kSignals.size()> before_{};
};

/// While it lives, prints what happens although the thread that runs the application may be stuck in a module; says for
/// what the end of a run waits, and ends the program when a second signal comes, or when the run was to end because of a
/// fault and a module does not return.
///
/// Threads: both functions are called by a thread of its own.
class EndWatch {
 public:
  /// `print`: what has happened since the last call. `rescue`: finishes what is being written; the program ends then.
  EndWatch(Application& application, std::function<void()> print, std::function<void()> rescue);

 private:
  void Run(const std::stop_token& stop);
  void Look();
  [[noreturn]] void Leave();

  Application& application_;
  const std::function<void()> print_;
  const std::function<void()> rescue_;
  std::string told_;
  std::jthread thread_;  // last: uses all of it
};

/// Asks services whose calls take long to end them, waits for that, and says so. What has not ended after 5 s, in words;
/// "" if all has.
[[nodiscard]] std::string EndOwnThreads(Runtime& runtime);

/// What clients of a running application ask of the program that runs it: that it ends, or runs again.
///
/// Threads: any.
class RunControl final : public ApplicationExtension {
 public:
  /// Whether the application could be built again from its file. Errors: why not.
  using Check = std::function<Result<void>()>;
  explicit RunControl(Check check) : check_(std::move(check)) {}

  void AddHooks(Application& application, ServiceHooks& hooks) override;

  /// Somebody has asked for the end of the run, or for another one.
  [[nodiscard]] bool is_asked() const noexcept { return is_asked_.load(); }
  [[nodiscard]] bool shall_restart() const noexcept { return shall_restart_.load(); }

 private:
  const Check check_;
  std::atomic<bool> is_asked_{false};
  std::atomic<bool> shall_restart_{false};
};

}  // namespace runnel::program
