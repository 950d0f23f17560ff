#pragma once

#include <functional>
#include <string>
#include <thread>

#include "plugins/application/application.h"

namespace runnel::program {

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

}  // namespace runnel::program
