#include "core/lockfree/thread_record.h"

namespace runnel {

namespace internal {
constinit ThreadRecord no_record;
thread_local constinit ThreadRecord* thread_record = &no_record;
constinit EpochDomain<> process_epochs;
constinit HazardDomain<> process_hazards;
}  // namespace internal

namespace {

// Records are only ever added, so no address comes back to life.
constinit std::atomic<ThreadRecord*> all_records{nullptr};

// Gives the record of a thread that ends to the next thread that starts.
struct Registration {
  ~Registration() {
    if (internal::thread_record == &internal::no_record) return;
    // release: pairs with the acquire in TakeRecord(); the thread's own notes are handed over.
    internal::thread_record->taken.store(false, std::memory_order_release);
    internal::thread_record = &internal::no_record;
  }
};

// Of a thread that has ended, or nullptr.
ThreadRecord* TakeRecord() noexcept {
  // acquire: pairs with the release in MakeRecord().
  for (ThreadRecord* record = all_records.load(std::memory_order_acquire); record != nullptr;
       record = record->next) {
    bool taken = false;
    if (record->taken.compare_exchange_strong(taken, true, std::memory_order_acquire,
                                              std::memory_order_relaxed)) {
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
  while (!all_records.compare_exchange_weak(record->next, record, std::memory_order_release,
                                            std::memory_order_relaxed)) {
  }
  return record;
}

}  // namespace

ThreadRecord& internal::RegisterThread() {
  static thread_local Registration registration;
  ThreadRecord* const before = TakeRecord();
  return *(thread_record = before != nullptr ? before : MakeRecord());
}

}  // namespace runnel
