#include "plugins/scheduling/cycle_runner.h"

#include <algorithm>
#include <exception>

#include "core/base/error.h"
#include "core/lockfree/thread_epoch.h"
#include "core/module/after_cycle.h"
#include "plugins/timing/latency_chain.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

namespace {

// Of the cycle that this thread is in, at whose end those who wait for data will be told; else
// nullptr.
thread_local constinit const Schedule* in_cycle_of __attribute__((tls_model("initial-exec"))) = nullptr;

// Of the cycle that this thread is in, if anything is noted of it.
thread_local constinit const CycleRunner* noting_runner __attribute__((tls_model("initial-exec"))) = nullptr;

bool IsToldAtTheEnd(const CycleRunner& runner) noexcept {
  return in_cycle_of != nullptr && std::ranges::find(*in_cycle_of->waiting, &runner) != in_cycle_of->waiting->end();
}

bool HasActivated(const Schedule& schedule) noexcept {
  return std::ranges::any_of(schedule.entries, [](const auto& entry) { return entry.element->is_activated(); });
}

// One that throws fails, and the others go on. The try block is around the loop and not within
// it: a task costs no more than its call.
void RunInTurn(std::span<const Schedule::Entry> entries, CycleMoment now, FaultDispatcher& faults) noexcept {
  auto entry = entries.begin();
  const auto fail = [&](const char* what) { (entry++)->element->Fail(what, now, faults); };
  while (entry != entries.end()) {
    try {
      for (; entry != entries.end(); ++entry) {
        if (entry->element->is_at_rest()) continue;
        internal::BeginModule();
        entry->run();
      }
    } catch (const std::exception& exception) {
      fail(exception.what());
    } catch (...) {
      fail(DescribeException().c_str());
    }
  }
}

}  // namespace

CycleRunner::~CycleRunner() { delete schedule_.load(std::memory_order_seq_cst); }

void CycleRunner::Install(std::unique_ptr<const Schedule> schedule) {
  const Schedule* const next = schedule.release();
  // seq_cst: one order with the epoch's operations; see core/lockfree/epoch.h.
  const Schedule* const previous = schedule_.exchange(next, std::memory_order_seq_cst);
  // What came for an element while no schedule had it has woken nobody, or a cycle that did not know
  // it. The exchange, this look and ScheduledElement::Wake() are in one order (seq_cst): either it is
  // found here, or it comes after the exchange, and then whoever takes the activation of this runner
  // finds `next`.
  if (next != nullptr && waits_for_data() && HasActivated(*next)) Activate();
  if (previous == nullptr) return;
  Retire([previous] { delete previous; });
}

const CycleRunner* CycleRunner::OfThisThread() noexcept { return noting_runner; }

bool CycleRunner::RunCycle(Cycle cycle, FaultDispatcher& faults) noexcept {
  const EpochGuard guard;
  if (gate_.is_closed()) [[unlikely]]
    return false;
  const AfterCycleScope after;
  const CycleScope scope(cycle);
  const Schedule* const schedule = this->schedule();
  if (schedule == nullptr) return true;
  in_cycle_of = schedule;
  // relaxed: for those who look while this runner is at rest. One thread writes.
  const std::uint64_t number = cycles_begun_.load(std::memory_order_relaxed) + 1;
  cycles_begun_.store(number, std::memory_order_relaxed);
  const CycleMoment now{cycle.now, number};
  noted_ = instruments_.load(std::memory_order_relaxed);
  const Time began = noted_ != 0 ? BeginNoting() : Time{};
  if (waits_for_data()) {
    RunActivated(*schedule, now, faults);
  } else {
    RunAll(*schedule, now, faults);
  }
  if (noted_ != 0) [[unlikely]]
    EndNoting(*schedule, began, now);
  in_cycle_of = nullptr;
  NotificationBatch notifications;
  for (CycleRunner* const waiting : *schedule->waiting) {
    if (waiting->is_activated()) notifications.Add(waiting->event_);
  }
  return true;
}

Time CycleRunner::BeginNoting() noexcept {
  noting_runner = this;
  return (noted_ & Instruments::kTrace) != 0 ? clock_.Now() : Time{};
}

void CycleRunner::EndNoting(const Schedule& schedule, Time began, CycleMoment now) noexcept {
  noting_runner = nullptr;
  if ((noted_ & Instruments::kTrace) == 0 || schedule.track == nullptr) return;
  schedule.track->NoteCycle({began, clock_.Now()}, now.time, now.number);
}

void CycleRunner::Run(std::span<const Schedule::Entry> entries, const Schedule& schedule, CycleMoment now,
                      FaultDispatcher& faults) noexcept {
  if (noted_ == 0) [[likely]]
    return RunInTurn(entries, now, faults);
  for (const Schedule::Entry& entry : entries) RunNoted(entry, schedule, now, faults);
}

void CycleRunner::RunNoted(const Schedule::Entry& entry, const Schedule& schedule, CycleMoment now,
                           FaultDispatcher& faults) noexcept {
  ScheduledElement& element = *entry.element;
  if (element.is_at_rest()) return;
  TraceTrack* const track = (noted_ & Instruments::kTrace) != 0 ? schedule.track : nullptr;
  TracedElement* const traced = track != nullptr ? element.traced() : nullptr;
  const ChainSteps* const chains = (noted_ & Instruments::kLatency) != 0 ? element.chains() : nullptr;
  const bool is_measured = traced != nullptr || (noted_ & Instruments::kProfile) != 0;
  const Time began = is_measured ? clock_.Now() : Time{};
  if (traced != nullptr) traced->track = track;
  if (chains != nullptr) chains->Begin();
  running_.Begin(element);
  RunInTurn({&entry, 1}, now, faults);
  running_.End();
  const Time ended = is_measured ? clock_.Now() : Time{};
  if (chains != nullptr) {
    chains->End(began + (ended - began) / 2, traced != nullptr ? track : nullptr);
  }
  if (!is_measured) return;
  if ((noted_ & Instruments::kProfile) != 0) element.meter(entry.phase).Add(ended - began);
  if (traced != nullptr) {
    track->NoteUpdate({began, ended}, entry.phase, traced->number, traced->ports);
  }
}

// Whether nothing need be asked of its elements any more.
bool CycleRunner::IsSettled(const Schedule& schedule) noexcept {
  if (!schedule.has_arrivals || settled_ == schedule.number) return true;
  const bool have_arrived = std::ranges::all_of(schedule.entries, &Schedule::Entry::HasArrived);
  if (have_arrived) settled_ = schedule.number;
  return have_arrived;
}

// An element that another thread may still be running is left out of this cycle.
void CycleRunner::RunAll(const Schedule& schedule, CycleMoment now, FaultDispatcher& faults) noexcept {
  if (IsSettled(schedule)) return Run(schedule.entries, schedule, now, faults);
  for (const Schedule::Entry& entry : schedule.entries) {
    if (entry.HasArrived()) Run({&entry, 1}, schedule, now, faults);
  }
}

// The entries of one element follow one another only by chance, so what has come for it is taken
// once, by its first task, and holds for the others.
void CycleRunner::RunActivated(const Schedule& schedule, CycleMoment now, FaultDispatcher& faults) noexcept {
  const bool is_settled = IsSettled(schedule);
  is_held_up_ = false;
  for (const Schedule::Entry& entry : schedule.entries) {
    RunIfActivated(entry, schedule, is_settled, now, faults);
  }
  // What came during the pass for those further down has been used in it; what came for those
  // further up, or from other threads, is for the next one. So is what came for those that only a
  // schedule of meanwhile has: whoever has activated this runner for them did so after the exchange,
  // which the load of the schedule finds then.
  (void)TakeActivation();
  if (this->schedule() != &schedule || HasActivated(schedule)) {
    activated_.store(true, std::memory_order_release);
  }
}

void CycleRunner::RunIfActivated(const Schedule::Entry& entry, const Schedule& schedule, bool is_settled,
                                 CycleMoment now, FaultDispatcher& faults) noexcept {
  ScheduledElement& element = *entry.element;
  // What has come for an element that another thread may still be running is not forgotten.
  if (!is_settled && !entry.HasArrived()) {
    if (element.is_activated()) is_held_up_ = true;
    return;
  }
  if (entry.is_first && element.TakeActivation()) element.set_in_pass(true);
  if (element.in_pass()) Run({&entry, 1}, schedule, now, faults);
  if (entry.is_last) element.set_in_pass(false);
}

void CycleRunner::Activate() noexcept {
  activated_.store(true, std::memory_order_release);
  // A thread that was added during this cycle is not among those told at its end.
  if (!IsToldAtTheEnd(*this)) event_.Notify();
}

// The element stays while the thread is in its cycle.
const char* RunningModulePath() noexcept {
  const CycleRunner* const runner = CycleRunner::OfThisThread();
  const ScheduledElement* const element = runner != nullptr ? runner->running().element() : nullptr;
  return element != nullptr ? element->path().c_str() : nullptr;
}

}  // namespace runnel
