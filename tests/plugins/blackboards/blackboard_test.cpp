// Values that several read and change, on a simulated clock.

#include <random>

#include "core/port/cycle.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/blackboards/blackboard_fixture.h"

namespace runnel::test {
namespace {

TEST_F(BlackboardTest, IsReadAsItBegan) {
  EXPECT_EQ(user().Seen(), Cells(10, 0));
  EXPECT_EQ(board().revision(), 1u);
}

TEST_F(BlackboardTest, AChangeIsAppliedInTheOwnersCycle) {
  EXPECT_EQ(user().Set(3, 7), CallStatus::kPending);
  EXPECT_EQ(user().Seen()[3], 0);
  Steps(1);
  EXPECT_EQ(user().Seen()[3], 7);
  EXPECT_THAT(user().told, ElementsAre("applied 2"));
}

TEST_F(BlackboardTest, WhoComesSecondIsToldOfTheOtherRevision) {
  AddUser("other");
  user().Set(1, 1);
  user("other").Set(1, 2);
  Steps(1);
  EXPECT_THAT(user().told, ElementsAre("applied 2"));
  EXPECT_THAT(user("other").told, ElementsAre("not applied 2"));
  EXPECT_EQ(user().Seen()[1], 1);
  user("other").Set(1, 2);
  Steps(1);
  EXPECT_EQ(user().Seen()[1], 2);
}

TEST_F(BlackboardTest, ChangesWithoutARevisionAreAppliedInOrder) {
  for (int i = 1; i <= 5; ++i) {
    auto transaction = user().map.Begin();
    transaction.change().push_back({static_cast<std::uint64_t>(i), i});
    transaction.change().push_back({0, i});
    ASSERT_EQ(transaction.CommitAnyway(), CallStatus::kPending);
  }
  Steps(1);
  EXPECT_EQ(user().Seen(), (Cells{5, 1, 2, 3, 4, 5, 0, 0, 0, 0}));
  EXPECT_EQ(board().revision(), 6u) << "each commit is a publication";
}

TEST_F(BlackboardTest, ATransactionThatIsDroppedChangesNothing) {
  user().map.Begin().change().push_back({1, 1});
  Steps(1);
  EXPECT_EQ(board().revision(), 1u);
}

TEST_F(BlackboardTest, AWrongChangeChangesNothingAndSaysWhy) {
  auto transaction = user().map.Begin();
  transaction.change().push_back({1, 5});
  transaction.change().push_back({10, 5});
  ASSERT_EQ(transaction.Commit([](const auto&) {}), CallStatus::kPending);
  user().Set(10, 5);
  Steps(1);
  EXPECT_EQ(user().Seen(), Cells(10, 0));
  EXPECT_THAT(user().told, SizeIs(1));
}

TEST_F(BlackboardTest, TheOwnerWritesWhatItLikes) {
  {
    const OwnCycle cycle(runtime.clock().Now());
    auto access = board().Write();
    access->assign(3, 9);
  }
  EXPECT_EQ(user().Seen(), Cells(3, 9));
  try {
    auto access = board().Write();
    access->clear();
    throw std::runtime_error("thinks better of it");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(user().Seen(), Cells(3, 9));
  {
    auto access = board().Write();
    access->clear();
    access.Discard();
  }
  EXPECT_EQ(user().Seen(), Cells(3, 9));
}

// What is appended twice shows.
struct Appended {
  int value = 0;
};
void Describe(TypeBuilder<Appended>& type) { type.Name("AppendedForTest").Field("value", &Appended::value); }
int appended_until_throw = -1;
Result<void> Apply(Cells& cells, const Appended& change) {
  cells.push_back(change.value);
  if (--appended_until_throw == 0) throw std::runtime_error("no memory");
  return {};
}
class AppendingOwner final : public Module {
 public:
  using Module::Module;
  Blackboard<Cells, Appended> list{this, "list", Cells()};

 private:
  void Update() override {}
};

TEST(BlackboardInReplay, AnExceptionLeavesNoChangeThatIsAppliedTwice) {
  Runtime runtime;
  auto& owner = runtime.Create<AppendingOwner>(runtime.root(), "owner");
  ASSERT_TRUE(runtime.MakeReady(owner));
  Cells expected;
  const auto commit_some = [&] {
    for (int i = 0; i < 10; ++i) {
      expected.push_back(i);
      EXPECT_TRUE(owner.list.CommitChange({i}));
    }
  };
  commit_some();  // each buffer has been used, and is brought up to date by the journal
  appended_until_throw = 1;
  EXPECT_THROW((void)owner.list.CommitChange({99}), std::runtime_error);
  commit_some();
  owner.list.Look([&](const Cells& cells) { EXPECT_EQ(cells, expected); });
}

TEST_F(BlackboardTest, AReaderKeepsWhatItHolds) {
  const auto held = user().map.value().Peek();
  for (int i = 0; i < 50; ++i) {
    user().Set(0, i);
    Steps(1);
  }
  EXPECT_EQ(*held, Cells(10, 0));
  EXPECT_EQ(held.sequence(), 1u);
  EXPECT_EQ(user().Seen()[0], 49);
}

TEST_F(BlackboardTest, SurvivesASwapOfTheOwnerWithWhatWaits) {
  user().Set(1, 1);
  Steps(1);
  user().Set(2, 2);
  Must({ReplaceModule{"/app/owner", "test/map_owner"}});
  EXPECT_EQ(user().Seen()[1], 1);
  Steps(1);
  EXPECT_EQ(user().Seen()[2], 2);
  EXPECT_THAT(user().told, ElementsAre("applied 2", "applied 3"));
}

TEST_F(BlackboardTest, AWriterThatDiesBlocksNobody) {
  AddUser("other");
  {
    auto transaction = user().map.Begin();
    transaction.change().push_back({1, 1});
    EXPECT_EQ(user("other").Set(2, 2), CallStatus::kPending);
    Steps(1);
  }
  user().Set(3, 3);
  Must({DeleteElement{"/app/user"}});
  Steps(1);
  EXPECT_EQ(user("other").Seen()[2], 2);
  EXPECT_EQ(user("other").Set(4, 4), CallStatus::kPending);
}

TEST_F(BlackboardTest, AFullQueueSaysSo) {
  for (int i = 0; i < 8; ++i) ASSERT_EQ(user().Set(0, i), CallStatus::kPending);
  EXPECT_EQ(user().Set(0, 9), CallStatus::kBusy);
}

// Whatever is changed, written, discarded, held and swapped: readers see what a plain list would have.
TEST_F(BlackboardTest, IsWhatAPlainListWouldBe) {
  std::mt19937 random(7);
  Cells expected(10, 0);
  std::vector<Lease<Cells>> held;
  for (int i = 0; i < 2000; ++i) {
    const auto index = random() % 12;
    switch (random() % 8) {
      case 0: {
        auto access = board().Write();
        (*access)[index % 10] = i;
        if (i % 3 == 0) {
          access.Discard();
        } else {
          expected[index % 10] = i;
        }
        break;
      }
      case 1:
        held.push_back(user().map.value().Peek());
        break;
      case 2:
        held.clear();
        break;
      case 3:
        if (random() % 10 == 0) Must({ReplaceModule{"/app/owner", "test/map_owner"}});
        break;
      default:
        user().Set(index, i);
        Steps(1);
        if (index < 10) expected[index] = i;
    }
    ASSERT_EQ(user().Seen(), expected) << i;
  }
}

// As a terminal, a page or a recording sees it.
TEST_F(BlackboardTest, IsChangedAndRecordedWithoutKnowingItsType) {
  using Changes = std::vector<ElementChange<int>>;
  using Record = CallRecord<CommitReply(CommitRequest<Changes>)>;
  auto& records = At<Output<Record>>("/app/owner/output/map_changes_calls");
  Input<Record> input(At<Group>("/app"), "records");
  ASSERT_TRUE(Port::Connect(records, input, {.queue = 10}));
  Callable& callable = *board().changes().port().FindAnnotation<Callable>();
  const auto call = callable.NewCall();
  ASSERT_TRUE(SetFromText(*callable.arguments(), "{change: [{index: 7, value: 5}]}", call->arguments()));
  ASSERT_EQ(call->Begin(runtime.clock().Now(), 1s), CallStatus::kPending);
  Steps(1);
  ASSERT_EQ(call->Poll(runtime.clock().Now()), CallStatus::kAnswered);
  EXPECT_EQ(ToText(*callable.reply(), call->reply()), "{is_applied: true, revision: 2}");
  EXPECT_EQ(user().Seen()[7], 5);
  EXPECT_THAT(TextOf(*input.Take()), HasSubstr("change: [{index: 7, value: 5}]"));
}

TEST_F(BlackboardTest, CommitsAllocateNothing) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "a sanitizer has the heap";
  auto& writer = user().map;
  auto& owner = board();
  const OwnCycle cycle(runtime.clock().Now());
  int applied = 0;
  const auto round = [&](int value) {
    auto transaction = writer.Begin();
    transaction.change().push_back({1, value});
    EXPECT_EQ(transaction.Commit([&applied](const auto& outcome) { applied += outcome->is_applied; }),
              CallStatus::kPending);
    owner.changes().Serve();
    writer.changes().Deliver();
  };
  for (int i = 0; i < 50; ++i) round(i);
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) round(i);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(applied, 150);
}

}  // namespace
}  // namespace runnel::test
