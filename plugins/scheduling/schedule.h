#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/lockfree/thread_epoch.h"
#include "core/module/executable.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {

/// By which others can tell whether a runner is still in a cycle that began before a change.
///
/// Threads:   Take() by the thread that runs the cycles, before its first; the rest from any.
/// Progress:  wait-free. It costs the cycles nothing: what is looked at is the thread's EpochGuard.
class CycleQuiescence {
 public:
  /// The calling thread runs all cycles from now on. Precondition: what another has run is over,
  /// and this thread knows (it was started after the other was joined).
  void Take() noexcept {
    const auto* const participant = &EpochGuard::Participant();
    // relaxed: only the thread of the cycles writes.
    if (participant_.load(std::memory_order_relaxed) == participant) return;
    // release: the participant is complete. The light fence of the first cycle's EpochGuard stands
    // between this and the loading of the schedule, and pairs with the heavy one in Begin(): who
    // finds nullptr after an installation knows that the first cycle loads what was installed.
    participant_.store(participant, std::memory_order_release);
  }

  /// True once no cycle is under way that may have loaded its schedule before `epoch` began. What
  /// those cycles did is then visible to the caller. Always true for runners that no thread has
  /// taken: one thread runs all of those.
  [[nodiscard]] bool HasLeft(std::uint64_t epoch) const noexcept {
    const auto* const participant = participant_.load(std::memory_order_acquire);
    return participant == nullptr || EpochDomain<>::HasPassed(*participant, epoch);
  }

 private:
  std::atomic<const EpochDomain<>::Participant*> participant_{nullptr};
};

/// By which others keep a runner between two of its cycles for a moment. Cycles pay one load of a line
/// that hardly ever changes.
///
/// Who closes the gate and then finds, by the runner's CycleQuiescence, that no cycle is under way that
/// began before, knows that none begins until it opens the gate: closing, heavy fence, looking at the
/// quiescence on one side; entering the guard, light fence, looking at the gate on the other.
///
/// Threads:  Close() and Open() in pairs, by any number of threads; the rest by the runner's.
class CycleGate {
 public:
  void Close() noexcept { closed_.fetch_add(1, std::memory_order_seq_cst); }
  void Open() noexcept {
    // release: pairs with the acquire in is_closed() and WaitUntilOpen(): the next cycle sees all
    // that was changed meanwhile.
    if (closed_.fetch_sub(1, std::memory_order_release) == 1) closed_.notify_all();
  }

  [[nodiscard]] bool is_closed() const noexcept { return closed_.load(std::memory_order_acquire) != 0; }
  /// Outside of the cycle and of its guard: this sleeps.
  void WaitUntilOpen() const noexcept {
    for (std::uint32_t closed = closed_.load(std::memory_order_acquire); closed != 0;
         closed = closed_.load(std::memory_order_acquire)) {
      closed_.wait(closed, std::memory_order_acquire);
    }
  }

 private:
  std::atomic<std::uint32_t> closed_{0};
};

/// All the schedules that take effect together. Elements that change threads with them are not run
/// by the new thread before the old one has left the cycles that began before this.
///
/// Threads:  Begin() once, under the structure lock; the rest from any thread. Progress: wait-free.
class Installation {
 public:
  /// After the last schedule of this installation is in its place.
  /// Returns the epoch before which all cycles may still be in older ones.
  std::uint64_t Begin() noexcept {
    // Passes a heavy fence between the exchanges and the store below.
    const std::uint64_t epoch = ProcessEpochs().Advance();
    // release: pairs with the acquire in HasBeenReachedBy(): all schedules are exchanged.
    epoch_.store(epoch, std::memory_order_release);
    return epoch;
  }

  /// Whether the runner of `quiescence` can no longer be in a cycle with an older schedule.
  [[nodiscard]] bool HasBeenReachedBy(const CycleQuiescence& quiescence) const noexcept {
    // acquire: pairs with the release in Begin().
    const std::uint64_t epoch = epoch_.load(std::memory_order_acquire);
    return epoch != kNotBegun && quiescence.HasLeft(epoch);
  }

 private:
  static constexpr std::uint64_t kNotBegun = 0;
  std::atomic<std::uint64_t> epoch_{kNotBegun};
};

class TraceTrack;

/// What one thread does in a cycle, ready to be run through. Never changed once made: a change of
/// the structure makes a new one, and the old one goes when no cycle can be using it.
struct Schedule {
  /// A runner that may still be running an element, since an installation that took it away.
  struct Before {
    std::shared_ptr<const CycleQuiescence> quiescence;
    std::shared_ptr<const Installation> installation;
    [[nodiscard]] bool HasLeft() const noexcept { return installation->HasBeenReachedBy(*quiescence); }
  };

  struct Entry {
    BoundCall run;
    std::shared_ptr<ScheduledElement> element;
    Phase phase = Phase::kUpdate;
    bool is_first = true;  ///< of the element's tasks
    bool is_last = true;
    /// Those who may still have been running the element when this entry was made.
    std::vector<Before> before = {};

    /// Whether no other thread can be running the element any more; once true it remains so, as
    /// long as a cycle is in a schedule with this entry.
    [[nodiscard]] bool HasArrived() const noexcept { return std::ranges::all_of(before, &Before::HasLeft); }
  };

  std::uint64_t number = 0;     ///< later ones of the same runner have higher numbers
  std::vector<Entry> entries;   ///< in the order of running
  bool has_arrivals = false;    ///< elements that others have had before
  TraceTrack* track = nullptr;  ///< where its cycles are noted; nullptr: nowhere
  /// The runners that wait for data; they are told at the end of the cycle, not in the midst of it.
  std::shared_ptr<const std::vector<CycleRunner*>> waiting;
};

}  // namespace runnel
