#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include "core/base/retry.h"
#include "core/lockfree/thread_record.h"

namespace runnel {

/// While one lives in a thread, nothing that the thread can reach through a port is destroyed.
///
/// Threads:     lives and dies in one thread; may be nested.
/// Allocation:  the first guard of a thread registers the thread, which allocates; make one at the
///              start of a real-time thread.
class EpochGuard {
 public:
  EpochGuard() : participant_(ThisThread().epoch) {
    if (internal::guard_depth++ == 0) ProcessEpochs().Enter(participant_);
  }
  ~EpochGuard() {
    if (--internal::guard_depth == 0) ProcessEpochs().Leave(participant_);
  }
  EpochGuard(const EpochGuard&) = delete;
  EpochGuard& operator=(const EpochGuard&) = delete;

  /// True if the calling thread holds a guard.
  [[nodiscard]] static bool HeldByThisThread() noexcept { return internal::guard_depth > 0; }

  /// By which others can tell what the calling thread has left; registers the thread, if this is
  /// its first. Never freed; the thread's only as long as it lives.
  [[nodiscard]] static EpochDomain<>::Participant& Participant() { return ThisThread().epoch; }

 private:
  EpochDomain<>::Participant& participant_;
};

/// A guard for one short look, inside which no other guard is made: it is not counted, which costs a thread that
/// looks again and again more than all the rest. Precondition: the thread holds none, and IsPossible().
class BriefEpochGuard {
 public:
  BriefEpochGuard() : participant_(internal::thread_record->epoch) { ProcessEpochs().Enter(participant_); }
  ~BriefEpochGuard() { ProcessEpochs().Leave(participant_); }
  BriefEpochGuard(const BriefEpochGuard&) = delete;
  BriefEpochGuard& operator=(const BriefEpochGuard&) = delete;

  /// Whether the calling thread is registered. Apart from the constructor, so that a way with a brief guard holds no
  /// call, for which it would have to put its registers aside.
  [[nodiscard]] static bool IsPossible() noexcept { return internal::thread_record != &internal::no_record; }

 private:
  EpochDomain<>::Participant& participant_;
};

/// Calls `use()` inside a guard: the one that the thread holds already, as in a cycle, or one made
/// for the call.
template <typename Use>
[[gnu::always_inline]] inline decltype(auto) Guarded(Use&& use) {
  if (EpochGuard::HeldByThisThread()) [[likely]]
    return std::forward<Use>(use)();
  const EpochGuard guard;
  return std::forward<Use>(use)();
}

/// Runs what is due of the retired, and deletes the closed pools of which nobody holds a buffer any
/// more. Returns how many of the retired are left.
std::size_t CollectRetired();

namespace internal {
/// All or nothing.
void AddRetired(std::function<void()> destroy);
}  // namespace internal

/// Runs `destroy` when no thread can still see what has been taken out before this call: at once if
/// no thread is reading, else during a later Retire() or CollectRetired(). Where there is no memory to keep it in, it waits
/// for some; what there is none for after all is never destroyed.
///
/// Threads: any; takes a lock and may allocate, so never from a cycle.
template <typename Destroy>
void Retire(Destroy destroy) {
  union Kept {
    explicit Kept(Destroy&& given) : destroy(std::move(given)) {}
    ~Kept() {}  // what is not to be destroyed stays
    Destroy destroy;
  } kept(std::move(destroy));
  if (Retry([&] { internal::AddRetired(kept.destroy); })) kept.destroy.~Destroy();
  CollectRetired();
}

/// Waits until every guard that exists now is gone. Precondition: this thread holds none.
void WaitForReaders();

}  // namespace runnel
