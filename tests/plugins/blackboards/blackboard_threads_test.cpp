// Owner, writers and readers in threads of their own; to be run under TSan.

#include <thread>

#include "tests/plugins/blackboards/blackboard_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

class BlackboardThreads : public BlackboardTest {
 protected:
  BlackboardThreads() : BlackboardTest(SchedulerOptions::ClockKind::kReal) {}
};

// Writers add one to the first two cells in transactions, and try again when they are told of another revision; readers
// see the two cells alike, and revisions that grow; the owner is made anew meanwhile.
TEST_F(BlackboardThreads, NoIncrementIsLostAndNoValueIsTorn) {
  constexpr int kIncrements = 40;
  std::atomic<int> left{2 * kIncrements};
  for (const char* const name : {"first", "second"}) {
    AddUser(name);
    Must({AssignToThread{std::string("/app/") + name, name == std::string("first") ? "fast" : "slow"}});
    auto& user = this->user(name);
    const auto mine = std::make_shared<int>(kIncrements);
    const auto is_waiting = std::make_shared<bool>(false);
    user.action = [&left, mine, is_waiting](MapUser& self) {
      if (*is_waiting || *mine == 0) return;
      auto transaction = self.map.Begin();
      if (!transaction) return;
      const int next = transaction.value()[0] + 1;
      for (const std::uint64_t index : {0, 1}) transaction.change().push_back({index, next});
      struct Shared {
        std::atomic<int>* left;
        int* mine;
        bool* is_waiting;
      };
      static thread_local Shared shared;
      shared = {&left, mine.get(), is_waiting.get()};
      const CallStatus status = transaction.Commit([to = &shared](const BlackboardWriter<Cells>::Outcome& outcome) {
        *to->is_waiting = false;
        if (!outcome || !outcome->is_applied) return;
        --*to->mine;
        --*to->left;
      });
      *is_waiting = status == CallStatus::kPending;
    };
  }
  ASSERT_TRUE(scheduler.Start());
  std::atomic<bool> is_over{false};
  std::vector<std::thread> readers;
  auto& input = user("first").map.value();
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&] {
      std::uint64_t before = 0;
      while (!is_over) {
        const auto read = input.Peek();
        EXPECT_EQ((*read)[0], (*read)[1]);
        EXPECT_GE(read.sequence(), before);
        before = read.sequence();
        std::this_thread::yield();
      }
    });
  }
  for (int i = 0; i < 3; ++i) Must({ReplaceModule{"/app/owner", "test/map_owner"}});
  WaitUntil("all increments are in", [&] { return left == 0; });
  is_over = true;
  for (auto& each : readers) each.join();
  scheduler.Stop();
  EXPECT_EQ(user("first").Seen()[0], 2 * kIncrements);
}

}  // namespace
}  // namespace runnel::test
