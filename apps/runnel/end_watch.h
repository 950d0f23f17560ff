#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "plugins/application/application.h"
#include "plugins/application/application_extension.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::program {

/// How a run ends: by signals, by clients who ask for that or for another run, and what is said until the application has gone.
///
/// From BeginThreads() on, Ctrl-C, SIGTERM and SIGHUP ask the scheduler to stop, so that the run ends in order; a second one
/// ends the program, a third at once. What the caller of the program has it ignore (nohup) stays ignored. It prints what
/// happens although the thread that runs the application may be stuck in a module, says for what the end waits, and ends
/// the program, too, when the run was to end because of a fault and a module does not return. After the run, a signal has
/// it say for what it waits, and one after that ends the program.
///
/// One at a time; it outlives the application.
/// Threads: any; BeginThreads() and EndThreads() by the one that runs the application. Both functions of BeginThreads() are
///          called by a thread of its own.
class EndWatch final : public ApplicationExtension {
 public:
  /// Whether the application could be built again from its file. Errors: why not.
  using Check = std::function<Result<void>()>;
  explicit EndWatch(Check check) : check_(std::move(check)) {}
  ~EndWatch() override;

  void AddHooks(Application& application, ServiceHooks& hooks) override;
  void End() noexcept override { WaitFor("what clients have asked for"); }
  void Release() noexcept override { WaitFor("one of its modules or plugins"); }

  /// `print`: what has happened since the last call. `rescue`: finishes what is being written; the program ends then.
  void BeginThreads(Application& application, std::function<void()> print, std::function<void()> rescue);
  /// The run has ended, and neither function is called any more. Asks services whose calls take long to end them, and
  /// waits for that. A thread that does not end can be left, but what it uses cannot be destroyed: after 5 s, or where a
  /// module is stuck, the program ends without.
  void EndThreads();

  /// A client has asked for the end of the run, or for another one.
  [[nodiscard]] bool is_asked() const noexcept { return is_asked_.load(); }
  [[nodiscard]] bool shall_restart() const noexcept { return shall_restart_.load(); }
  /// A signal has come since the newest BeginThreads().
  [[nodiscard]] static bool has_come() noexcept;

  /// The run is over, and neither function of BeginThreads() is called any more. `what`: what comes to its end now, in words.
  void WaitFor(std::string_view what) noexcept;

 private:
  void Run(const std::stop_token& stop);
  void Look();
  [[noreturn]] void Leave(const std::vector<StuckModule>& stuck);

  const Check check_;
  std::atomic<bool> is_asked_{false};
  std::atomic<bool> shall_restart_{false};
  Application* application_ = nullptr;
  std::map<int, struct sigaction> before_;  // of each signal
  std::function<void()> print_;
  std::function<void()> rescue_;
  std::mutex mutex_;     // of the next three
  std::string awaited_;  // what goes, in words; "": the run
  std::string told_;
  int seen_ = 0;         // signals, after the run
  std::jthread thread_;  // last: uses all of it
};

}  // namespace runnel::program
