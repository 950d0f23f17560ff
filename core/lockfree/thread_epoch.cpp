#include "core/lockfree/thread_epoch.h"

#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/lockfree/patience.h"

namespace runnel {

namespace {

struct Retired {
  std::uint64_t epoch;
  std::function<void()> destroy;
};

struct RetiredList {
  std::mutex mutex;
  std::deque<Retired> entries;  // by their epochs, the oldest first
};

// Never destroyed: ports of static lifetime may retire parts while the process ends.
RetiredList& TheRetired() {
  static auto* const list = new RetiredList;
  return *list;
}

}  // namespace

void Retire(std::function<void()> destroy) {
  {
    const std::lock_guard lock(TheRetired().mutex);
    TheRetired().entries.push_back({ProcessEpochs().Advance(), std::move(destroy)});
  }
  CollectRetired();
}

std::size_t CollectRetired() {
  std::vector<Retired> due;
  std::size_t left = 0;
  {
    const std::lock_guard lock(TheRetired().mutex);
    std::deque<Retired>& entries = TheRetired().entries;
    // Who is in the way of one is in the way of all later ones, which need not be looked at.
    while (!entries.empty() && ProcessEpochs().HasPassed(entries.front().epoch)) {
      due.push_back(std::move(entries.front()));
      entries.pop_front();
    }
    left = entries.size();
  }
  // Outside the lock: a destructor may retire further parts.
  for (const Retired& entry : due) entry.destroy();
  return left;
}

void WaitForReaders() {
  RUNNEL_CHECK(!EpochGuard::HeldByThisThread(),
               "a thread cannot wait for readers while it reads itself, as in Update()");
  const std::uint64_t epoch = ProcessEpochs().Advance();
  for (int round = 0; !ProcessEpochs().HasPassed(epoch); ++round) {
    WaitOneRound(round);
  }
  CollectRetired();
}

}  // namespace runnel
