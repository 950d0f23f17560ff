#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/epoch.h"
#include "core/lockfree/hazard.h"

namespace runnel {

/// What a thread says to those who take parts away or reuse buffers: that it is inside (epochs),
/// and which buffers it holds (hazards).
///
/// Lives for ever, and is handed to the next thread that starts when its own has ended; so there
/// are as many as there have been threads at one time. A lease that was handed to another thread
/// may still hold a slot of it then, which is no harm.
struct ThreadRecord {
  EpochDomain<>::Participant epoch;
  HazardRecord<> hazards;
  std::atomic<bool> taken{true};  ///< by a living thread
  ThreadRecord* next = nullptr;   ///< constant once added
};

extern template class HazardDomain<>;

namespace internal {
extern constinit EpochDomain<> process_epochs;
extern constinit HazardDomain<> process_hazards;
// What a thread has before its first look at a port: nobody's record, in which nothing is ever changed.
extern constinit ThreadRecord no_record;
// initial-exec: one load instead of a call, also from plugins; the variable lives in the core,
// which is there from the start of the program.
extern thread_local constinit ThreadRecord* thread_record __attribute__((tls_model("initial-exec")));
// How many guards the thread holds. Apart from the record, so that "is this thread inside a guard?" is one look.
extern thread_local constinit std::uint32_t guard_depth __attribute__((tls_model("initial-exec")));
ThreadRecord& RegisterThread();
}  // namespace internal

/// The domains of the process. Threads: any.
[[nodiscard]] inline EpochDomain<>& ProcessEpochs() noexcept { return internal::process_epochs; }
[[nodiscard]] inline HazardDomain<>& ProcessHazards() noexcept { return internal::process_hazards; }

/// The calling thread's record. Allocation: the first call of a thread may allocate.
[[nodiscard]] inline ThreadRecord& ThisThread() {
  ThreadRecord* const record = internal::thread_record;
  return record != &internal::no_record ? *record : internal::RegisterThread();
}

}  // namespace runnel
