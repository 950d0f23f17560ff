#pragma once

#include <functional>

#include "core/lockfree/epoch.h"

namespace runnel {

/// The one epoch domain of the process. Ports read under it; a scheduler's thread holds it for a
/// whole cycle, so that the reads inside cost nothing more.
using ProcessEpochDomain = EpochDomain<>;
[[nodiscard]] ProcessEpochDomain& ProcessEpochs() noexcept;

namespace internal {
// initial-exec: one load instead of a call, also from plugins; the variable lives in the core,
// which is there from the start of the program.
extern thread_local constinit ProcessEpochDomain::Participant* thread_participant
    __attribute__((tls_model("initial-exec")));
ProcessEpochDomain::Participant& RegisterThread();
}  // namespace internal

/// While one lives in a thread, nothing that the thread can reach through a port is destroyed.
///
/// Threads:     lives and dies in one thread; may be nested.
/// Allocation:  the first guard of a thread registers the thread, which allocates; make one at the
///              start of a real-time thread.
class EpochGuard {
 public:
  EpochGuard() : participant_(Participant()) { ProcessEpochs().Enter(participant_); }
  ~EpochGuard() { ProcessEpochs().Leave(participant_); }
  EpochGuard(const EpochGuard&) = delete;
  EpochGuard& operator=(const EpochGuard&) = delete;

  /// True if the calling thread holds a guard.
  [[nodiscard]] static bool HeldByThisThread() noexcept {
    return internal::thread_participant != nullptr && internal::thread_participant->depth > 0;
  }

  /// By which others can tell what the calling thread has left; registers the thread, if this is
  /// its first. Never freed; the thread's only as long as it lives.
  [[nodiscard]] static ProcessEpochDomain::Participant& Participant() {
    return internal::thread_participant != nullptr ? *internal::thread_participant
                                                   : internal::RegisterThread();
  }

 private:
  ProcessEpochDomain::Participant& participant_;
};

/// Runs `destroy` when no thread can still see what has been taken out before this call: at once if
/// no thread is reading, else during a later Retire() or CollectRetired().
///
/// Threads: any; takes a lock and may allocate, so never from a cycle.
void Retire(std::function<void()> destroy);

/// Runs what is due of the retired. Returns how many are left.
std::size_t CollectRetired();

/// Waits until every guard that exists now is gone. Precondition: this thread holds none.
void WaitForReaders();

}  // namespace runnel
