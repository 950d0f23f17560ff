#include "core/lockfree/thread_epoch.h"

#include <list>
#include <mutex>

#include "core/base/check.h"
#include "core/lockfree/backoff.h"

namespace runnel {

namespace {

struct Retired {
  std::uint64_t epoch = 0;
  std::function<void()> destroy;
};

struct RetiredList {
  std::mutex mutex;
  std::list<Retired> entries;  // by their epochs, the oldest first
};

// Never destroyed: ports of static lifetime may retire parts while the process ends.
RetiredList& TheRetired() {
  static auto* const list = new RetiredList;
  return *list;
}

}  // namespace

void internal::AddRetired(std::function<void()> destroy) {
  std::list<Retired> entry;
  entry.emplace_back().destroy = std::move(destroy);
  std::list<Retired>& entries = TheRetired().entries;
  const std::lock_guard lock(TheRetired().mutex);
  entry.front().epoch = ProcessEpochs().Advance();
  entries.splice(entries.end(), entry);
}

std::size_t CollectRetired() {
  std::list<Retired> due;  // moved without memory
  std::size_t left = 0;
  {
    const std::lock_guard lock(TheRetired().mutex);
    std::list<Retired>& entries = TheRetired().entries;
    // Who is in the way of one is in the way of all later ones, which need not be looked at.
    while (!entries.empty() && ProcessEpochs().HasPassed(entries.front().epoch)) {
      due.splice(due.end(), entries, entries.begin());
    }
    left = entries.size();
  }
  // Outside the lock: a destructor may retire further parts.
  for (const Retired& entry : due) entry.destroy();
  (void)ProcessHazards().Reclaim();
  return left;
}

void WaitForReaders() {
  RUNNEL_CHECK(!EpochGuard::HeldByThisThread(),
               "a thread cannot wait for readers while it reads itself, as in Update()");
  const std::uint64_t epoch = ProcessEpochs().Advance();
  for (int round = 0; !ProcessEpochs().HasPassed(epoch); ++round) {
    BackOff(round);
  }
  CollectRetired();
}

}  // namespace runnel
