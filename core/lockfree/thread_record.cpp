#include "core/lockfree/thread_record.h"

#include <optional>

#include <pthread.h>

namespace runnel {

template class HazardDomain<>;

namespace internal {
constinit ThreadRecord no_record;
thread_local constinit ThreadRecord* thread_record = &no_record;
thread_local constinit std::uint32_t guard_depth = 0;
constinit EpochDomain<> process_epochs;
constinit HazardDomain<> process_hazards;
}  // namespace internal

namespace {

// Records are only ever added, so no address comes back to life.
constinit std::atomic<ThreadRecord*> all_records{nullptr};

// Gives the record of a thread that ends to the next thread that starts.
void GiveBack(void* record) noexcept {
  internal::thread_record = &internal::no_record;
  // release: pairs with the acquire in TakeRecord(); the thread's own notes are handed over.
  static_cast<ThreadRecord*>(record)->taken.store(false, std::memory_order_release);
}

// Has GiveBack() called when the calling thread ends. Not by a thread_local object: those of the
// thread that are destroyed later may publish and read, and would take a record that nobody gives
// back. A key's destructor comes after all of them, and again if a further one needs it.
void GiveBackAtTheEnd(ThreadRecord* record) noexcept {
  static const auto key = [] {
    pthread_key_t made{};
    return pthread_key_create(&made, GiveBack) == 0 ? std::optional(made) : std::nullopt;
  }();
  // Without a key, or memory for it, the record is not used again.
  if (key) (void)pthread_setspecific(*key, record);
}

// Of a thread that has ended, or nullptr.
ThreadRecord* TakeRecord() noexcept {
  // acquire: pairs with the release in MakeRecord().
  for (ThreadRecord* record = all_records.load(std::memory_order_acquire); record != nullptr; record = record->next) {
    bool taken = false;
    if (record->taken.compare_exchange_strong(taken, true, std::memory_order_acquire, std::memory_order_relaxed)) {
      return record;
    }
  }
  return nullptr;
}

ThreadRecord* MakeRecord() {
  auto* const record = new ThreadRecord;
  ProcessEpochs().Add(record->epoch);
  ProcessHazards().Add(record->hazards);
  record->next = all_records.load(std::memory_order_relaxed);
  while (
      !all_records.compare_exchange_weak(record->next, record, std::memory_order_release, std::memory_order_relaxed)) {
  }
  return record;
}

}  // namespace

ThreadRecord& internal::RegisterThread() {
  ThreadRecord* const before = TakeRecord();
  thread_record = before != nullptr ? before : MakeRecord();
  GiveBackAtTheEnd(thread_record);
  return *thread_record;
}

}  // namespace runnel
