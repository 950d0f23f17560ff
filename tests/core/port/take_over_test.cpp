#include <thread>

#include "core/base/check.h"
#include "plugins/real_time_check/sanitizer.h"
#include "tests/core/port/port_fixture.h"
#include "tests/core/port/pull_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TakeOverTest : public PullTest {
 protected:
  template <typename T>
  Output<T>& MakeOutput(const std::string& name, OutputOptions options = {}) {
    return MakeSender<T>(name, std::move(options)).out;
  }
  template <typename T>
  Input<T>& MakeInput(const std::string& name, InputOptions options = {}) {
    return MakeReceiver<T>(name, std::move(options)).in;
  }
};

TEST_F(TakeOverTest, AnInputGoesOnWhereTheOtherHasStopped) {
  auto& sender = MakeOutput<int>("sender");
  auto& before = MakeInput<int>("before");
  auto& after = MakeInput<int>("after");
  Connect(sender, before);
  sender.Publish(1);
  EXPECT_TRUE(before.Read().is_new());

  after.TakeOver(before);
  const auto seen = after.Read();
  ASSERT_TRUE(seen.has_value());
  EXPECT_FALSE(seen.is_new()) << "the other has read it already";
  sender.Publish(2);
  EXPECT_TRUE(after.Read().is_new());
  EXPECT_FALSE(before.Read().has_value());
  EXPECT_THAT(sender.outgoing().front().to, &after);
  EXPECT_TRUE(before.incoming().empty());
}

TEST_F(TakeOverTest, WhatWaitsInAQueueIsTakenOnceByWhoeverComesNext) {
  auto& sender = MakeOutput<int>("sender");
  auto& before = MakeInput<int>("before");
  auto& after = MakeInput<int>("after");
  Connect(sender, before, {.queue = 10, .on_full = OnFull::kRefuse});
  for (int i = 1; i <= 6; ++i) sender.Publish(i);
  EXPECT_EQ(*before.Take(), 1);
  EXPECT_EQ(*before.Take(), 2);

  after.TakeOver(before);
  sender.Publish(7);
  std::vector<int> taken;
  after.Drain([&](const auto& each) { taken.push_back(*each); });
  EXPECT_THAT(taken, ElementsAre(3, 4, 5, 6, 7));
  EXPECT_FALSE(before.Take().has_value());

  before.TakeOver(after);  // and back again
  sender.Publish(8);
  EXPECT_EQ(*before.Take(), 8);
  EXPECT_FALSE(before.Take().has_value());
}

TEST_F(TakeOverTest, ReadersOfAnOutputStayWhereTheyAre) {
  auto& before = MakeOutput<Scan>("before");
  auto& after = MakeOutput<Scan>("after");
  auto& receiver = MakeInput<Scan>("receiver");
  auto& queued = MakeInput<Scan>("queued");
  Connect(before, receiver);
  Connect(before, queued, {.queue = 5});
  before.Publish(Scan{{1.f}, 1});
  EXPECT_TRUE(receiver.Read().is_new());

  after.TakeOver(before);
  const auto kept = receiver.Read();
  EXPECT_EQ(kept->number, 1) << "the last value stays until the next comes";
  EXPECT_FALSE(kept.is_new());
  after.Publish(Scan{{2.f}, 2});
  EXPECT_EQ(receiver.Read()->number, 2);
  EXPECT_EQ(receiver.Read().missed(), 0u);
  before.Publish(Scan{{3.f}, 3});
  EXPECT_EQ(receiver.Read()->number, 2) << "nobody reads the other any more";
  EXPECT_EQ(queued.Take()->number, 1);
  EXPECT_EQ(queued.Take()->number, 2);
  EXPECT_FALSE(queued.Take().has_value());
  EXPECT_THAT(receiver.Sources(), ElementsAre(&after));
}

TEST_F(TakeOverTest, AConnectionMadeLaterFindsTheSourceThatHasTakenOver) {
  auto& before = MakeOutput<int>("before");
  auto& after = MakeOutput<int>("after");
  auto& other = MakeOutput<int>("other");
  auto& receiver = MakeInput<int>("receiver");
  Connect(before, receiver);
  after.TakeOver(before);
  Connect(other, receiver);
  after.Publish(5);
  EXPECT_EQ(receiver.Get(), 5);
  EXPECT_TRUE(Port::Disconnect(after, receiver));
  after.Publish(6);
  other.Publish(7);
  EXPECT_EQ(receiver.Get(), 7);
}

TEST_F(TakeOverTest, AModuleConnectedToItselfStaysSo) {
  auto& sender = MakeOutput<int>("sender");
  auto& receiver = MakeInput<int>("receiver");
  auto& next_sender = MakeOutput<int>("next_sender");
  auto& next_receiver = MakeInput<int>("next_receiver");
  Connect(sender, receiver);
  next_receiver.TakeOver(receiver);
  next_sender.TakeOver(sender);
  next_sender.Publish(3);
  EXPECT_EQ(next_receiver.Get(), 3);
  EXPECT_TRUE(Port::Disconnect(next_sender, next_receiver));
}

TEST_F(TakeOverTest, ProvidersStayWithTheirOutputs) {
  auto& before = MakeOutput<int>("before", kPullable);
  auto& after = MakeOutput<int>("after", kPullable);
  auto& receiver = MakeInput<int>("receiver", kPulls);
  before.SetProvider([](int& value) { return value = 1, true; });
  after.SetProvider([](int& value) { return value = 2, true; });
  Connect(before, receiver);
  EXPECT_EQ(*receiver.Read(), 1);
  after.TakeOver(before);
  EXPECT_EQ(*receiver.Read(), 2);
  before.TakeOver(after);
  EXPECT_EQ(*receiver.Read(), 1);
}

TEST_F(TakeOverTest, OutputsOfTwoKindsOfPullingBringTheirReadersOver) {
  auto& before = MakeOutput<int>("before");
  auto& after = MakeOutput<int>("after", kPullable);
  auto& receiver = MakeInput<int>("receiver", kPulls);
  after.SetProvider([](int& value) { return value = 2, true; });
  Connect(before, receiver);
  before.Publish(1);
  after.TakeOver(before);
  EXPECT_EQ(*receiver.Read(), 2);
}

TEST_F(TakeOverTest, AnInputThatPullsDoesSoAfterTakingOverFromOneThatDoesNot) {
  auto& sender = MakeOutput<int>("sender", kPullable);
  auto& before = MakeInput<int>("before");
  auto& after = MakeInput<int>("after", kPulls);
  sender.SetProvider([](int& value) { return value = 4, true; });
  Connect(sender, before);
  EXPECT_FALSE(before.Read().has_value());
  after.TakeOver(before);
  EXPECT_EQ(*after.Read(), 4);
}

TEST_F(TakeOverTest, RefusesWhatDoesNotFit) {
  auto& number = MakeOutput<int>("number");
  auto& scan = MakeOutput<Scan>("scan");
  auto& receiver = MakeInput<int>("receiver");
  EXPECT_THAT(Port::CheckTakeOver(scan, number).error().message, HasSubstr("carries"));
  EXPECT_THAT(Port::CheckTakeOver(receiver, number).error().message,
              HasSubstr("one is an input, the other is an output"));
  Connect(number, receiver);
  auto& second = MakeOutput<int>("second");
  EXPECT_THAT(Port::CheckTakeOver(number, second).error().message, HasSubstr("is connected"));
  EXPECT_THROW(number.TakeOver(second), ProgrammingError);
}

// A viewer looks at the outputs while they exchange their channels, and a reader drains its queue.
TEST_F(TakeOverTest, ViewersAndReadersAtTheOtherEndNoticeNothing) {
  constexpr int kRounds = RUNNEL_UNDER_SANITIZER ? 300 : 3000;
  auto& a = MakeOutput<Scan>("a");
  auto& b = MakeOutput<Scan>("b");
  auto& receiver = MakeInput<Scan>("receiver");
  Connect(a, receiver, {.queue = 100, .on_full = OnFull::kRefuse});
  std::atomic<bool> done{false};
  std::thread viewer([&] {
    while (!done) {
      for (auto* port : {&a, &b}) {
        port->VisitLatest([](const void* value, Time) { EXPECT_GT(static_cast<const Scan*>(value)->number, 0); });
      }
    }
  });
  std::thread reader([&] {
    int last = 0;
    while (last < kRounds) {
      receiver.Drain([&](const auto& each) { EXPECT_EQ(each->number, ++last); });
    }
  });
  auto* active = &a;
  auto* idle = &b;
  for (int i = 1; i <= kRounds; ++i) {
    while (active->WouldRefuse()) std::this_thread::yield();
    active->Publish(Scan{{}, i});
    idle->TakeOver(*active);
    std::swap(active, idle);
  }
  reader.join();
  done = true;
  viewer.join();
}

}  // namespace
}  // namespace runnel::test
