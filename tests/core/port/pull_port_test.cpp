// Values that readers have made when they read, beside those that are published.

#include <atomic>
#include <stdexcept>
#include <thread>

#include "core/base/check.h"
#include "plugins/testing/guards.h"
#include "tests/core/port/pull_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using PullPortTest = PullTest;

TEST_F(PullPortTest, ReadingMakesAValueOnlyIfTheInputPulls) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& pulling = MakeReceiver<int>("pulling", kPulls);
  auto& pushed = MakeReceiver<int>("pushed");
  Connect(sender.out, pulling.in);
  Connect(sender.out, pushed.in);
  EXPECT_FALSE(pulling.in.Read()) << "nobody provides";
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  EXPECT_FALSE(pushed.in.Read());
  EXPECT_FALSE(pulling.in.Peek());
  EXPECT_EQ(*pulling.in.Read(), 1);
  EXPECT_EQ(*pushed.in.Read(), 1) << "what was pulled is published to all";
  EXPECT_TRUE(pulling.in.Read().is_new());
  EXPECT_EQ(pulling.in.Get(), 3);
  EXPECT_EQ(pulling.in.Get(0), 4);
  EXPECT_EQ(*pulling.in.Peek(), 4);
  EXPECT_EQ(pushed.in.Get(), 4);
  EXPECT_EQ(sender.out.publications(), 4u);
}

TEST_F(PullPortTest, SoItIsWithValuesInBuffers) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 3, .may_grow = false}, .pullable = true});
  auto& pulling = MakeReceiver<Scan>("pulling", kPulls);
  auto& queued = MakeReceiver<Scan>("queued");
  Connect(sender.out, pulling.in);
  Connect(sender.out, queued.in, {.queue = 4});
  sender.out.SetProvider([this](Scan& value) { return Count(value, counter); });
  for (int i = 1; i <= 10; ++i) {
    const auto lease = pulling.in.Read();
    EXPECT_EQ(lease->number, i);
    EXPECT_EQ(queued.in.Take()->number, i);
    EXPECT_EQ(sender.out.Publish(Scan{{}, -i}), PublishStatus::kPublished);
    EXPECT_EQ(queued.in.Take()->number, -i);
  }
}

TEST_F(PullPortTest, WhatIsPulledIsAsOldAsWhatItsProviderHasRead) {
  auto& measured = MakeSender<int>("measured");
  auto& between = MakeReceiver<int>("between", {.ageing = Ageing::kTimesOut});
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& pulling = MakeReceiver<int>("pulling", {.strategy = Strategy::kPull, .ageing = Ageing::kTimesOut});
  auto& driving = MakeSender<int>("driving");
  Connect(measured.out, between.in);
  Connect(sender.out, pulling.in);
  sender.out.SetProvider([&](int& value) {
    value = between.in.Read() ? 1 : 0;
    return true;
  });
  clock.Advance(1s);
  measured.out.Publish(1);
  clock.Advance(4s);
  const CycleScope cycle({.now = Time(5s)});
  driving.out.Publish(1);
  EXPECT_EQ(pulling.in.Read().timestamp(), Time(1s));
  EXPECT_EQ(pulling.in.Read().publication_time(), Time(5s));
  EXPECT_EQ(CurrentCycle()->stamp, Time(1s)) << "who has read it";
}

TEST_F(PullPortTest, WhoPullsDoesNotMakeItOld) {
  auto& old = MakeSender<int>("old");
  auto& ages = MakeReceiver<int>("ages", {.ageing = Ageing::kTimesOut});
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& pulling = MakeReceiver<int>("pulling", kPulls);
  Connect(old.out, ages.in);
  Connect(sender.out, pulling.in);
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  old.out.Publish(1);
  clock.Advance(5s);
  const CycleScope cycle({.now = Time(5s)});
  ASSERT_TRUE(ages.in.Read());
  EXPECT_EQ(pulling.in.Read().timestamp(), Time(5s));
  EXPECT_EQ(CurrentCycle()->stamp, Time()) << "its own values are";
}

TEST_F(PullPortTest, AConnectionMayAskForIt) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& receiver = MakeReceiver<int>("receiver");
  auto& proxy = runtime.Create<ProxyPort>(runtime.root(), "proxy", Port::Direction::kInput, TypeOf<int>());
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  Connect(sender.out, receiver.in, {.pull = true});
  EXPECT_EQ(*receiver.in.Read(), 1);
  EXPECT_EQ(receiver.in.Get(), 2);
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  Connect(sender.out, receiver.in);
  EXPECT_EQ(receiver.in.Get(), 2);
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  Connect(sender.out, proxy);
  Connect(proxy, receiver.in, {.pull = true});
  EXPECT_EQ(*receiver.in.Read(), 3);
}

TEST_F(PullPortTest, AConnectionPullsNeitherWithAQueueNorWithoutAProvider) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& plain = MakeSender<int>("plain");
  auto& receiver = MakeReceiver<int>("receiver");
  const auto queued = Port::Connect(sender.out, receiver.in, {.queue = 1, .pull = true});
  ASSERT_FALSE(queued);
  EXPECT_EQ(queued.error().message, "a connection that pulls cannot have a queue");
  const auto pushed = Port::Connect(plain.out, receiver.in, {.pull = true});
  ASSERT_FALSE(pushed);
  EXPECT_EQ(pushed.error().message, "cannot be pulled: it has no provider");
  Connect(sender.out, receiver.in, {.pull = true});
  const auto taken_over = Port::CheckTakeOver(plain.out, sender.out);
  ASSERT_FALSE(taken_over);
  EXPECT_EQ(taken_over.error().path, "/plain/out");
}

TEST_F(PullPortTest, StrategyAndProviderChangeWhileInUse) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 8});
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  sender.out.Publish(100);
  EXPECT_EQ(receiver.in.strategy(), Strategy::kPush);
  EXPECT_EQ(*receiver.in.Read(), 100);
  receiver.in.SetStrategy(Strategy::kPull);
  EXPECT_EQ(receiver.in.strategy(), Strategy::kPull);
  EXPECT_EQ(*receiver.in.Read(), 1);
  sender.out.SetProvider([](int& value) { return value = 50, true; });
  EXPECT_EQ(*receiver.in.Read(), 50);
  sender.out.SetProvider({});
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kOld);
  receiver.in.SetStrategy(Strategy::kPush);
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  EXPECT_EQ(*receiver.in.Read(), 50);
  EXPECT_THAT(TakeAll(receiver.in), testing::ElementsAre(100, 1, 50)) << "the queue stayed";
}

TEST_F(PullPortTest, AProviderThatHasNothingLeavesTheValueOfBefore) {
  auto& sender = MakeSender<Scan>("sender", kPullable);
  auto& receiver = MakeReceiver<Scan>("receiver", kPulls);
  Connect(sender.out, receiver.in);
  sender.out.Publish(Scan{{}, 1});
  sender.out.SetProvider([](Scan& value) { return value.number = 2, false; });
  EXPECT_EQ(receiver.in.Read()->number, 1);
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kOld);
  EXPECT_EQ(sender.out.pull_failures(), 0u);
}

TEST_F(PullPortTest, AProviderThatThrowsIsCountedAndTheNextPullWorks) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& receiver = MakeReceiver<int>("receiver", kPulls);
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  sender.out.SetProvider([this](int& value) {
    if (++counter == 1) throw std::runtime_error("no reading");
    return value = 2, true;
  });
  EXPECT_EQ(*receiver.in.Read(), 1);
  EXPECT_EQ(sender.out.pull_failures(), 1u);
  EXPECT_EQ(*receiver.in.Read(), 2);
  EXPECT_EQ(sender.out.Publish(3), PublishStatus::kPublished);
  EXPECT_EQ(sender.out.pull_failures(), 1u);
}

TEST_F(PullPortTest, AnExhaustedFixedPoolIsAFailureToo) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 1, .may_grow = false}, .pullable = true});
  auto& receiver = MakeReceiver<Scan>("receiver", kPulls);
  Connect(sender.out, receiver.in);
  sender.out.SetProvider([this](Scan& value) { return Count(value, counter); });
  const auto kept = receiver.in.Read();
  EXPECT_EQ(receiver.in.Read()->number, 1);
  EXPECT_EQ(sender.out.pull_failures(), 1u);
  EXPECT_TRUE(sender.out.Loan()) << "the publisher has buffers of its own";
}

TEST_F(PullPortTest, WhoeverComesDuringAPullGoesWithout) {
  auto& sender = MakeSender<Scan>("sender", kPullable);
  auto& receiver = MakeReceiver<Scan>("receiver", kPulls);
  auto& other = MakeReceiver<Scan>("other", kPulls);
  Connect(sender.out, receiver.in);
  Connect(sender.out, other.in);
  sender.out.Publish(Scan{{}, 1});
  sender.out.SetProvider([&](Scan& value) {
    value.number = 2;
    EXPECT_EQ(other.in.Read()->number, 1);
    EXPECT_EQ(sender.out.Publish(Scan{{}, 3}), PublishStatus::kBusy);
    auto loan = sender.out.Loan();
    EXPECT_EQ(sender.out.Publish(std::move(loan)), PublishStatus::kBusy);
    EXPECT_TRUE(loan) << "stays with its owner";
    EXPECT_THROW(sender.out.SetProvider({}), ProgrammingError) << "would wait for itself";
    return true;
  });
  EXPECT_EQ(receiver.in.Read()->number, 2);
  EXPECT_EQ(sender.out.pull_failures(), 0u);
}

TEST_F(PullPortTest, OfSeveralSourcesAllThatProvideAreAsked) {
  auto& first = MakeSender<int>("first", kPullable);
  auto& second = MakeSender<int>("second", kPullable);
  auto& third = MakeSender<int>("third");
  auto& receiver = MakeReceiver<int>("receiver", kPulls);
  for (auto* sender : {&first, &second, &third}) Connect(sender->out, receiver.in);
  third.out.Publish(0);
  first.out.SetProvider([](int& value) { return value = 1, true; });
  EXPECT_EQ(*receiver.in.Read(), 1);
  second.out.SetProvider([](int& value) { return value = 2, true; });
  EXPECT_EQ(*receiver.in.Read(), 2) << "is published last";
  EXPECT_EQ(first.out.publications(), 2u);
  EXPECT_EQ(second.out.publications(), 1u);
}

TEST_F(PullPortTest, APullGoesOnThroughAChain) {
  auto& source = MakeSender<int>("source", kPullable);
  auto& middle_in = MakeReceiver<int>("middle_in", kPulls);
  auto& middle_out = MakeSender<int>("middle_out", kPullable);
  auto& receiver = MakeReceiver<int>("receiver", kPulls);
  Connect(source.out, middle_in.in);
  Connect(middle_out.out, receiver.in);
  source.out.SetProvider([this](int& value) { return Count(value, counter); });
  middle_out.out.SetProvider([&](int& value) { return value = 10 * *middle_in.in.Read(), true; });
  EXPECT_EQ(*receiver.in.Read(), 10);
  EXPECT_EQ(*receiver.in.Read(), 20);
}

TEST_F(PullPortTest, PulledValuesBearTheTimeOfTheReadersCycle) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& receiver = MakeReceiver<int>("receiver", kPulls);
  Connect(sender.out, receiver.in);
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  clock.Set(Time(Duration(5)));
  EXPECT_EQ(receiver.in.Read().timestamp(), Time(Duration(5)));
  const CycleScope cycle({.now = Time(Duration(7))});
  EXPECT_EQ(receiver.in.Read().timestamp(), Time(Duration(7)));
}

TEST_F(PullPortTest, OnlyAPullableOutputHasAProvider) {
  auto& sender = MakeSender<int>();
  EXPECT_THROW(sender.out.SetProvider([](int&) { return true; }), ProgrammingError);
}

TEST_F(PullPortTest, APullWakesWhoWaits) {
  auto& sender = MakeSender<int>("sender", kPullable);
  auto& pulling = MakeReceiver<int>("pulling", kPulls);
  auto& waiting = MakeReceiver<int>("waiting");
  Connect(sender.out, pulling.in);
  Connect(sender.out, waiting.in);
  sender.out.SetProvider([this](int& value) { return Count(value, counter); });
  EXPECT_FALSE(pulling.in.Wait(Duration(1))) << "waiting does not pull";
  EXPECT_EQ(sender.out.publications(), 0u);
  std::thread reader([&] { (void)pulling.in.Read(); });
  EXPECT_TRUE(waiting.in.Wait(std::chrono::seconds(30)));
  reader.join();
}

TEST_F(PullPortTest, PullingNeitherAllocatesNorLocksNorCallsTheSystem) {
  auto& small = MakeSender<int>("small", kPullable);
  auto& large = MakeSender<Scan>("large", kPullable);
  auto& small_receiver = MakeReceiver<int>("small_receiver", kPulls);
  auto& large_receiver = MakeReceiver<Scan>("large_receiver", kPulls);
  Connect(small.out, small_receiver.in);
  Connect(large.out, large_receiver.in);
  small.out.SetProvider([this](int& value) { return Count(value, counter); });
  large.out.SetProvider([this](Scan& value) { return Count(value, counter); });
  const CycleScope cycle({.now = Time(Duration(1))});
  const auto body = [&] {
    (void)small_receiver.in.Read();
    (void)small_receiver.in.Get();
    (void)large_receiver.in.Read();
    (void)small.out.Publish(1);
    (void)large.out.Publish(large.out.Loan());
  };
  for (int i = 0; i < 50; ++i) body();
  {
    const AllocationGuard allocations;
    const LockProbe locks;
    for (int i = 0; i < 100; ++i) body();
    EXPECT_EQ(allocations.allocations(), 0u);
    EXPECT_EQ(locks.locks(), 0u);
  }
  SystemCallProbe calls;
  for (int i = 0; i < 100; ++i) body();
  EXPECT_EQ(calls.Stop(), -1);
}

}  // namespace
}  // namespace runnel::test
