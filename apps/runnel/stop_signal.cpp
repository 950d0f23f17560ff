#include "apps/runnel/stop_signal.h"

#include <atomic>

namespace runnel::program {

namespace {

std::atomic<Scheduler*> to_be_stopped{nullptr};
std::atomic<bool> signal_has_come{false};
static_assert(std::atomic<Scheduler*>::is_always_lock_free, "a signal handler must not lock");

void Handle(int) {
  signal_has_come.store(true);
  if (Scheduler* scheduler = to_be_stopped.load()) scheduler->RequestStop();
}

}  // namespace

StopSignal::StopSignal(Scheduler& scheduler) {
  signal_has_come.store(false);
  to_be_stopped.store(&scheduler);
  struct sigaction action {};
  action.sa_handler = Handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
  to_be_stopped.store(nullptr);
}

bool StopSignal::has_come() const noexcept { return signal_has_come.load(); }

}  // namespace runnel::program
