#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/base/clock.h"

namespace runnel {

/// What has happened, for who brings to safety what can be.
struct Crash {
  std::string module;  ///< path of the one that ran; "" if the thread was in no cycle
  std::string signal;  ///< "SIGSEGV"
};

struct CrashReportOptions {
  /// Is written when the program crashes, with what stderr gets; "": none.
  std::string file = {};
  /// Called by a thread of its own while the one that has crashed waits: all threads but that run on. It may take
  /// locks, and must reckon with never getting one that the other thread has.
  std::function<void(const Crash&)> rescue = {};
  /// How long the thread that has crashed waits for it.
  Duration patience = std::chrono::seconds(3);
};

/// While it lives, a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) names the module that ran, with the stack that
/// led there, on stderr and in a file; then the program ends by that signal as it would have without.
///
///     CrashReport report({.file = "crash.txt", .rescue = [&](const Crash&) { FinishRecording(); }});
///
/// The handler does only what handlers may do: it writes what it has, wakes a thread that stands ready, and waits.
/// Modules are named if the scheduler notes what runs (SchedulerOptions::notes_running_tasks).
///
/// Ownership:  one at a time in a process; what had been installed before comes back. Under a sanitizer, which
///             reports crashes itself, it does nothing.
/// Threads:    made and destroyed by one. Threads of the scheduler have a stack for the handler; so has the one that
///             makes this.
class CrashReport {
 public:
  explicit CrashReport(CrashReportOptions options);
  ~CrashReport();

 private:
  class Installed;
  const std::unique_ptr<Installed> installed_;
};

}  // namespace runnel
