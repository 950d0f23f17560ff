// A blackboard has the value of before or the one that was committed, wherever memory runs out or a change throws, and its
// buffers never go back to what was.

#include <array>
#include <new>
#include <optional>

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/blackboards/blackboard_fixture.h"

namespace runnel::test {
namespace {

using Words = std::vector<std::string>;
using WordChange = std::vector<ElementChange<std::string>>;

std::string Long(int number) { return std::string(100, 'x') + std::to_string(number); }

class WordsOwner : public Module {
 public:
  using Module::Module;
  Blackboard<Words> words{this, "words", Words(4, Long(0)), {.queue = 8, .journal = 2}};

 protected:
  void Update() override {}
};

class WordsUser final : public Module {
 public:
  using Module::Module;
  BlackboardWriter<Words> words{this, "words"};
  std::optional<WordChange> wish;
  int begun = 0;
  int told = 0;

 private:
  void Update() override {
    if (!wish) return;
    const WordChange wished = *std::exchange(wish, {});
    auto transaction = words.Begin();
    transaction.change() = wished;
    if (transaction.Commit([this](const auto&) { ++told; }) == CallStatus::kPending) ++begun;
  }
};

/// Takes the place of the owner, and fails at once.
class FailingOwner final : public WordsOwner {
 public:
  using WordsOwner::WordsOwner;
  static inline std::size_t nth = 0;

 private:
  void Update() override {
    {
      const FaultInjection injection(InjectedFault::kAllocation, nth);
      (void)words.CommitChange({{0, Long(1000)}, {1, Long(1001)}});
    }
    throw std::runtime_error("has failed");
  }
};

class BlackboardFaults : public EditorTest {
 protected:
  BlackboardFaults() {
    Register<WordsOwner>("test/words_owner");
    Register<WordsUser>("test/words_user");
    Register<FailingOwner>("test/failing_owner");
    Must({CreateModule{"/app/owner", "test/words_owner"}, CreateModule{"/app/user", "test/words_user"},
          ConnectPorts{"/app/owner/words", "/app/user/words"},
          ConnectPorts{"/app/owner/words_changes", "/app/user/words_changes"}});
    for (int i = 0; i < 5; ++i) CommitAnother();
  }
  Blackboard<Words>& board() { return At<WordsOwner>("/app/owner").words; }
  WordsUser& user() { return At<WordsUser>("/app/user"); }
  Words Now() {
    Words now;
    board().Look([&](const Words& words) { now = words; });
    return now;
  }
  WordChange Another() {
    ++count;
    const auto at = static_cast<std::uint64_t>(count % 4);
    return {{at, Long(count)}, {(at + 1) % 4, Long(-count)}};
  }
  void Note(const WordChange& change) {
    for (const auto& each : change) expected[each.index] = each.value;
  }
  void CommitAnother() {
    const WordChange change = Another();
    ASSERT_TRUE(board().CommitChange(change));
    Note(change);
    ASSERT_EQ(Now(), expected);
  }
  /// By all buffers that there are.
  void ExpectItGoesOn() {
    std::array<Lease<Words>, 3> held;
    for (auto& each : held) {
      CommitAnother();
      each = user().words.value().Read();
    }
    for (int i = 0; i < 6 && !HasFatalFailure(); ++i) CommitAnother();
  }

  Words expected = Words(4, Long(0));
  int count = 0;
};

TEST_F(BlackboardFaults, AChangeIsCommittedOrNot) {
  // Memory is there again at once, or only when all of it is over.
  for (const std::size_t further : {std::size_t(0), std::size_t(1000)}) {
    WordChange change = Another();
    bool is_committed = false;
    const auto commit = [&] {
      is_committed = false;
      try {
        is_committed = board().CommitChange(change).has_value();
      } catch (const std::bad_alloc&) {
      }
    };
    const std::size_t points = AtEachPoint(
        InjectedFault::kAllocation, commit,
        [&](bool has_struck) {
          ASSERT_NE(is_committed, has_struck);
          if (is_committed) Note(change);
          ASSERT_EQ(Now(), expected);
          ExpectItGoesOn();
          change = Another();
        },
        further);
    EXPECT_GT(points, 2u);
  }
}

TEST_F(BlackboardFaults, WhatTheOwnerWritesIsCommittedOrNot) {
  for (const std::size_t further : {std::size_t(0), std::size_t(1000)}) {
    for (const bool throws : {false, true}) {
      std::string word = Long(++count);
      bool is_committed = false;
      const auto write = [&] {
        is_committed = false;
        try {
          {
            auto access = board().Write();
            (*access)[1] = word;
            if (throws) *access = Words();  // what it had is to be copied again
            if (throws) throw 7;
          }
          is_committed = true;
        } catch (...) {
        }
      };
      (void)AtEachPoint(
          InjectedFault::kAllocation, write,
          [&](bool has_struck) {
            ASSERT_TRUE(has_struck || is_committed != throws);
            if (is_committed) expected[1] = word;
            ASSERT_EQ(Now(), expected);
            ExpectItGoesOn();
            word = Long(++count);
          },
          further);
    }
  }
}

TEST_F(BlackboardFaults, WhatIsDiscardedIsNotThere) {
  std::string word = Long(++count);
  for (const std::size_t further : {std::size_t(0), std::size_t(1000)}) {
    (void)AtEachPoint(
        InjectedFault::kAllocation,
        [&] {
          try {
            auto access = board().Write();
            (*access)[2] = word;
            *access = Words();  // what it had is to be copied again
            access.Discard();
          } catch (const std::bad_alloc&) {
          }
        },
        [&](bool) {
          ASSERT_EQ(Now(), expected);
          ExpectItGoesOn();
          word = Long(++count);
        },
        further);
  }
}

// By the service, in cycles: each commit is told, or the module that has failed is.
TEST_F(BlackboardFaults, WhatAUserWishesIsCommittedOrToldAsNot) {
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck; ++nth) {
    SCOPED_TRACE(nth);
    ExpectItGoesOn();
    const WordChange change = Another();
    user().wish = change;
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      (void)scheduler.RunUntil(runtime.clock().Now() + 20ms);
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    has_struck = injection.has_struck();
    Steps(3);
    const auto faults = scheduler.TakeFaults();
    ASSERT_TRUE(!faults.empty() || user().told == 1);
    if (Now() != expected) Note(change);
    ASSERT_EQ(Now(), expected);
    Must({ReplaceModule{"/app/owner", "test/words_owner"}, ReplaceModule{"/app/user", "test/words_user"}});
    Steps(8);
    ASSERT_EQ(Now(), expected);
    ExpectItGoesOn();
  }
}

// What a successor has left half changed is known to the owner that comes back.
TEST_F(BlackboardFaults, WhoComesBackHasTheValueOfBefore) {
  for (FailingOwner::nth = 1; FailingOwner::nth < 20; ++FailingOwner::nth) {
    SCOPED_TRACE(FailingOwner::nth);
    ExpectItGoesOn();
    Must({ReplaceModule{"/app/owner", "test/failing_owner"}});
    (void)scheduler.RunUntil(runtime.clock().Now() + 20ms);
    ASSERT_THAT(scheduler.TakeFaults(), SizeIs(1));
    ASSERT_EQ(FindModuleType(At<FrameworkElement>("/app/owner")), "test/words_owner");
    const Words now = Now();
    const bool is_committed = now[0] == Long(1000);
    if (is_committed) Note({{0, Long(1000)}, {1, Long(1001)}});
    ASSERT_EQ(now, expected);
    ExpectItGoesOn();
    ASSERT_FALSE(HasFatalFailure());
    expected[0] = Long(++count);
    ASSERT_TRUE(board().CommitChange({{0, expected[0]}}));
  }
}

}  // namespace
}  // namespace runnel::test
