#include "apps/runnel/stop_signal.h"

#include <atomic>
#include <thread>

namespace runnel::program {

namespace {

std::atomic<Scheduler*> to_be_stopped{nullptr};
std::atomic<int> handlers{0};  // that are under way, in whichever thread
std::atomic<int> signals{0};   // that have come
static_assert(std::atomic<Scheduler*>::is_always_lock_free, "a signal handler must not lock");

// The first one stops the run, the second has the program end in order, the third ends it at once.
void Handle(int) {
  const bool is_last = signals.fetch_add(1) > 0;
  for (const int signal : StopSignal::kSignals) {
    struct sigaction current {};
    sigaction(signal, nullptr, &current);
    if (is_last && current.sa_handler == Handle) std::signal(signal, SIG_DFL);
  }
  // All of them seq_cst: either the destructor sees this handler, or this sees that there is nothing to
  // stop any more.
  handlers.fetch_add(1);
  if (Scheduler* scheduler = to_be_stopped.load()) scheduler->RequestStop();
  handlers.fetch_sub(1);
}

}  // namespace

StopSignal::StopSignal(Scheduler& scheduler) {
  signals.store(0);
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

bool StopSignal::has_come() noexcept { return signals.load() > 0; }

bool StopSignal::has_come_again() noexcept { return signals.load() > 1; }

}  // namespace runnel::program
