#include "core/lockfree/thread_epoch.h"

#include <atomic>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/check.h"
#include "plugins/testing/fault_injection.h"
#include "plugins/testing/guards.h"
#include "tests/support/threads.h"
#include "tests/support/wait_until.h"
#include "tests/support/yielding_atomic.h"

namespace runnel {
namespace {

TEST(EpochDomainTest, HasPassedOnceWhoEnteredBeforeHasLeft) {
  EpochDomain<> domain;
  EpochDomain<>::Participant early, late;
  domain.Add(early);
  domain.Add(late);
  domain.Enter(early);
  const std::uint64_t epoch = domain.Advance();
  EXPECT_FALSE(domain.HasPassed(epoch));
  domain.Enter(late);  // entered after the change: does not matter to it
  domain.Leave(early);
  EXPECT_TRUE(domain.HasPassed(epoch));
  EXPECT_FALSE(domain.HasPassed(domain.Advance()));
  domain.Leave(late);
}

TEST(EpochGuardTest, OnlyTheOutermostOneEntersAndLeaves) {
  std::uint64_t epoch = 0;
  {
    const EpochGuard outer;
    epoch = ProcessEpochs().Advance();
    { const EpochGuard inner; }
    EXPECT_FALSE(ProcessEpochs().HasPassed(EpochGuard::Participant(), epoch));
    const EpochGuard another;
    EXPECT_FALSE(ProcessEpochs().HasPassed(EpochGuard::Participant(), epoch));
  }
  EXPECT_TRUE(ProcessEpochs().HasPassed(EpochGuard::Participant(), epoch));
}

TEST(BriefEpochGuardTest, KeepsWhatIsTakenOutMeanwhile) {
  std::uint64_t epoch = 0;
  {
    { const EpochGuard registers_this_thread; }
    ASSERT_TRUE(BriefEpochGuard::IsPossible());
    const BriefEpochGuard guard;
    epoch = ProcessEpochs().Advance();
    EXPECT_FALSE(ProcessEpochs().HasPassed(EpochGuard::Participant(), epoch));
  }
  EXPECT_TRUE(ProcessEpochs().HasPassed(EpochGuard::Participant(), epoch));
}

TEST(EpochGuardTest, IsKnownToItsThreadOnly) {
  EXPECT_FALSE(EpochGuard::HeldByThisThread());
  const EpochGuard guard;
  EXPECT_TRUE(EpochGuard::HeldByThisThread());
  std::thread([] { EXPECT_FALSE(EpochGuard::HeldByThisThread()); }).join();
}

TEST(EpochGuardTest, NeitherAllocatesNorLocksOnceTheThreadIsKnown) {
  { const EpochGuard first; }
  const test::AllocationGuard allocations;
  const test::LockProbe locks;
  { const EpochGuard guard; }
  EXPECT_EQ(allocations.allocations(), 0u);
  EXPECT_EQ(locks.locks(), 0u);
}

int Participants() {
  int participants = 0;
  for (auto* each = ProcessEpochs().first(); each != nullptr; each = each->next) ++participants;
  return participants;
}

TEST(EpochGuardTest, PlaceOfAThreadThatEndedIsUsedAgain) {
  std::thread([] { const EpochGuard guard; }).join();
  const int before = Participants();
  for (int i = 0; i < 10; ++i) std::thread([] { const EpochGuard guard; }).join();
  EXPECT_EQ(Participants(), before);
}

// Objects of the thread that are older than its first guard are destroyed after all others.
TEST(EpochGuardTest, PlaceIsUsedAgainAlsoIfAnObjectOfTheThreadReadsWhileTheThreadEnds) {
  struct ReadsAtTheEnd {
    ~ReadsAtTheEnd() { const EpochGuard guard; }
  };
  const auto body = [] {
    thread_local ReadsAtTheEnd object;
    (void)&object;
    const EpochGuard guard;
  };
  std::thread(body).join();
  const int before = Participants();
  for (int i = 0; i < 10; ++i) std::thread(body).join();
  EXPECT_EQ(Participants(), before);
}

TEST(RetireTest, DestroysAtOnceWhenNobodyReads) {
  bool destroyed = false;
  Retire([&] { destroyed = true; });
  EXPECT_TRUE(destroyed);
  EXPECT_EQ(CollectRetired(), 0u);
}

TEST(RetireTest, NeedsNoMemoryAtOnce) {
  auto part = std::make_shared<int>(1);
  const std::weak_ptr<int> known = part;
  test::FaultInjection injection(test::InjectedFault::kAllocation, 1, 4);
  Retire([held = std::move(part)] {});
  injection.End();
  EXPECT_TRUE(injection.has_struck());
  EXPECT_TRUE(known.expired());
}

TEST(RetireTest, WaitsForThoseWhoReadMeanwhile) {
  bool destroyed = false;
  {
    const EpochGuard guard;
    Retire([&] { destroyed = true; });
    EXPECT_FALSE(destroyed);
    EXPECT_EQ(CollectRetired(), 1u);
    EXPECT_FALSE(destroyed);
  }
  EXPECT_EQ(CollectRetired(), 0u);
  EXPECT_TRUE(destroyed);
}

TEST(RetireTest, DestructorsMayRetireFurtherParts) {
  bool destroyed = false;
  Retire([&] { Retire([&] { destroyed = true; }); });
  CollectRetired();
  EXPECT_TRUE(destroyed);
}

TEST(WaitForReadersTest, FromWithinAGuardIsAProgrammingError) {
  const EpochGuard guard;
  EXPECT_THROW(WaitForReaders(), ProgrammingError);
}

TEST(WaitForReadersTest, ReturnsWhenTheGuardsOfBeforeAreGoneAndDestroysWhatIsDue) {
  std::atomic<bool> entered{false}, retired{false}, leaving{false}, destroyed{false};
  std::thread reader([&] {
    const EpochGuard guard;
    entered = true;
    test::WaitUntil("something is retired", [&] { return retired.load(); });
    EXPECT_FALSE(destroyed);
    leaving = true;
  });
  test::WaitUntil("the reader has entered", [&] { return entered.load(); });
  Retire([&] { destroyed = true; });
  EXPECT_FALSE(destroyed);
  retired = true;
  WaitForReaders();
  EXPECT_TRUE(leaving);
  EXPECT_TRUE(destroyed);
  reader.join();
}

// Readers look at what a pointer points to while a writer exchanges and retires it.
TEST(RetireStressTest, PartIsNeverDestroyedUnderAReader) {
  struct Part {
    ~Part() { alive = false; }
    std::atomic<bool> alive{true};
  };
  std::atomic<Part*> current{new Part};
  std::atomic<int> dead{0}, writing{1};
  test::RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (int i = 0; i < 3000; ++i) {
        Part* const old = current.exchange(new Part, std::memory_order_seq_cst);
        Retire([old] { delete old; });
      }
      writing = 0;
      return;
    }
    while (writing > 0) {
      const EpochGuard guard;
      const Part* const part = current.load(std::memory_order_seq_cst);
      if (!part->alive) ++dead;
      test::MaybeYield();
      if (!part->alive) ++dead;
    }
  });
  EXPECT_EQ(dead, 0);
  Part* const last = current.load();
  Retire([last] { delete last; });
  EXPECT_EQ(CollectRetired(), 0u);
}

TEST(EpochDomainStressTest, PartIsNeverReusedUnderAReaderAtAnyInterleaving) {
  using Domain = EpochDomain<test::YieldingAtomic>;
  Domain domain;
  Domain::Participant participants[2];
  for (auto& each : participants) domain.Add(each);
  std::atomic<bool> alive[2] = {true, true};
  test::YieldingAtomic<int> current{0};
  std::atomic<int> dead{0}, writing{1};
  test::RunTogether(3, [&](unsigned index) {
    if (index == 2) {
      for (int i = 0; i < 1000; ++i) {
        const int old = i % 2;
        alive[1 - old] = true;
        current.exchange(1 - old, std::memory_order_seq_cst);
        const std::uint64_t epoch = domain.Advance();
        test::YieldUntil("the epoch has passed", [&] { return domain.HasPassed(epoch); });
        alive[old] = false;
      }
      writing = 0;
      return;
    }
    while (writing > 0) {
      domain.Enter(participants[index]);
      const int part = current.load(std::memory_order_seq_cst);
      if (!alive[part]) ++dead;
      domain.Leave(participants[index]);
    }
  });
  EXPECT_EQ(dead, 0);
}

}  // namespace
}  // namespace runnel
