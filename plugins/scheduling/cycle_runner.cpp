#include "plugins/scheduling/cycle_runner.h"

#include <algorithm>
#include <exception>

#include "core/lockfree/thread_epoch.h"
#include "core/port/cycle.h"

namespace runnel {

namespace {

// Whether this thread is in a cycle, at whose end those who wait for data will be told.
thread_local constinit bool tells_at_the_end = false;

}  // namespace

CycleRunner::~CycleRunner() { delete schedule_.load(std::memory_order_seq_cst); }

void CycleRunner::Install(std::unique_ptr<const Schedule> schedule) {
  // seq_cst: one order with the epoch's operations; see core/lockfree/epoch.h.
  const Schedule* const previous =
      schedule_.exchange(schedule.release(), std::memory_order_seq_cst);
  if (previous != nullptr) Retire([previous] { delete previous; });
}

Duration CycleRunner::RunCycle(const CycleTimes& times, FaultDesk& desk) noexcept {
  const SteadyClock machine;
  const Time began = machine.Now();
  const EpochGuard guard;
  const CycleScope scope({times.now, times.period});
  const Schedule* const schedule = this->schedule();
  if (schedule == nullptr) return {};
  tells_at_the_end = true;
  if (waits_for_data()) {
    RunActivated(*schedule, times.now, desk);
  } else {
    for (const Schedule::Entry& entry : schedule->entries) RunTask(entry, times.now, desk);
  }
  tells_at_the_end = false;
  const Duration execution = machine.Now() - began;
  for (CycleRunner* const waiting : schedule->waiting) {
    if (waiting->is_activated()) waiting->event_.Notify();
  }
  return execution;
}

// The entries of one element follow one another only by chance, so what has come for it is taken
// once, by its first task, and holds for the others.
void CycleRunner::RunActivated(const Schedule& schedule, Time now, FaultDesk& desk) noexcept {
  for (const Schedule::Entry& entry : schedule.entries) {
    if (entry.is_first && entry.element->TakeActivation()) entry.element->set_in_pass(true);
    if (entry.element->in_pass()) RunTask(entry, now, desk);
    if (entry.is_last) entry.element->set_in_pass(false);
  }
  // What came during the pass for those further down has been used in it; what came for those
  // further up, or from other threads, is for the next one.
  (void)TakeActivation();
  const bool more = std::ranges::any_of(
      schedule.entries, [](const auto& entry) { return entry.element->is_activated(); });
  if (more) activated_.store(true, std::memory_order_release);
}

void CycleRunner::RunTask(const Schedule::Entry& entry, Time now, FaultDesk& desk) noexcept {
  ScheduledElement& element = *entry.element;
  if (!element.TryEnter()) {
    if (waits_for_data()) element.Wake();  // what has come is not forgotten
    return;
  }
  if (!element.is_stopped()) {
    try {
      entry.run();
    } catch (const std::exception& exception) {
      element.Fail(exception.what(), now, desk);
    } catch (...) {
      element.Fail("unknown exception", now, desk);
    }
  }
  element.Leave();
}

void CycleRunner::Activate() noexcept {
  activated_.store(true, std::memory_order_release);
  if (!tells_at_the_end) event_.Notify();
}

}  // namespace runnel
