#include "apps/runnel/stop_signal.h"

#include <atomic>
#include <thread>

namespace runnel::program {

namespace {

std::atomic<Scheduler*> to_be_stopped{nullptr};
std::atomic<int> handlers{0};  // that are under way, in whichever thread
std::atomic<bool> signal_has_come{false};
static_assert(std::atomic<Scheduler*>::is_always_lock_free, "a signal handler must not lock");

// The first one stops the run; those that come after it end the program.
void Handle(int) {
  signal_has_come.store(true);
  for (const int signal : StopSignal::kSignals) {
    struct sigaction current {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler == Handle) std::signal(signal, SIG_DFL);
  }
  // All of them seq_cst: either the destructor sees this handler, or this sees that there is nothing to
  // stop any more.
  handlers.fetch_add(1);
  if (Scheduler* scheduler = to_be_stopped.load()) scheduler->RequestStop();
  handlers.fetch_sub(1);
}

}  // namespace

StopSignal::StopSignal(Scheduler& scheduler) {
  signal_has_come.store(false);
  to_be_stopped.store(&scheduler);
  struct sigaction action {};
  action.sa_handler = Handle;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  to_be_stopped.store(nullptr);
  // The scheduler may go after this; a handler that has found it is about to end.
  while (handlers.load() != 0) std::this_thread::yield();
}

bool StopSignal::has_come() noexcept { return signal_has_come.load(); }

}  // namespace runnel::program
