// A call allocates nothing, in neither cycle.

#include "core/port/cycle.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

TEST_F(ServiceTest, CallsAllocateNothing) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "a sanitizer has the heap";
  const std::string text = "a text that is longer than what fits into a string itself";
  auto& asks = asker();
  auto& serves = server();
  int sum = 0;
  const auto round = [&] {
    EXPECT_EQ(asks.twice.Call([&sum](const CallOutcome<int>& outcome) { sum += *outcome; }, 1), CallStatus::kPending);
    EXPECT_EQ(asks.twice.Send(2), CallStatus::kPending);
    auto future = asks.reset.Begin();
    serves.twice.Serve();
    serves.reset.Serve();
    asks.twice.Deliver();
    EXPECT_TRUE(future.is_done());
  };
  const OwnCycle cycle(runtime.clock().Now());
  for (int i = 0; i < 10; ++i) round();
  const AllocationGuard guard;
  for (int i = 0; i < 100; ++i) round();
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.releases(), 0u);
  EXPECT_EQ(sum, 220);
}

// What values have elsewhere is kept in the places of calls: a text of the same length finds its memory again.
TEST_F(ServiceTest, TextsFindTheirMemoryAgain) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "a sanitizer has the heap";
  const std::string text = "a text that is longer than what fits into a string itself";
  auto& asks = asker();
  const OwnCycle cycle(runtime.clock().Now());
  const auto send = [&] {
    (void)asks.repeat.Send(text, 0);
    server().repeat.Serve();
  };
  send();
  const AllocationGuard guard;
  EXPECT_EQ(asks.repeat.Send(text, 0), CallStatus::kPending);
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace runnel::test
