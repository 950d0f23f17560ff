// Values that the thread of a cycle sends itself, when its cycle has ended, beside those that the network's thread sends.
#include "tests/plugins/network/after_cycle_sending.h"

#include <atomic>
#include <stop_token>
#include <thread>

#include <gmock/gmock.h>

#include "core/port/probe_port.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/testing/guards.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

TEST_F(AfterCycleSending, WhatCyclesPublishIsSentWhenTheyHaveEnded) {
  Begin();
  SendFirst();
  int last = 0;
  WaitUntil("some are sent after cycles", [&] {
    PublishInCycle(++last);
    return Count("after cycles") >= 20;
  });
  WaitForPlace(last);
}

TEST_F(AfterCycleSending, OnlyTheNewestOfACycleIsSent) {
  Begin();
  SendFirst();
  {
    const OneCycle cycle(a_.runtime.clock().Now());
    for (int i = 1; i <= 50; ++i) a_.module.place.Publish({1.0 * i, 0});
  }
  WaitForPlace(50);
  EXPECT_LE(Count("sent"), 3);
}

TEST_F(AfterCycleSending, WithinACycleNothingIsAllocatedAndTheSystemIsNotCalled) {
  Begin();
  SendFirst();
  PublishInCycle(1);
  {
    const OneCycle cycle(a_.runtime.clock().Now());
    const AllocationGuard guard;
    SystemCallProbe calls;
    for (int i = 2; i <= 50; ++i) a_.module.place.Publish({1.0 * i, 0});
    EXPECT_EQ(calls.Stop(), -1);
    EXPECT_EQ(guard.allocations(), 0u);
  }
  WaitForPlace(50);
}

TEST_F(AfterCycleSending, WhatOthersPublishGoesByTheNetworksThread) {
  Begin();
  SendFirst();
  PublishOutside(1);
  WaitForPlace(1);
  a_.module.place.Publish({2, 0});
  WaitForPlace(2);
  EXPECT_THAT(a_.Text(), HasSubstr("as /place"));
  EXPECT_THAT(a_.Text(), Not(HasSubstr("after cycles")));
}

TEST_F(AfterCycleSending, LargeValuesStayWithTheNetworksThread) {
  Begin();
  double last = 0;
  const auto publish = [&](std::size_t size) {
    {
      const OneCycle cycle(a_.runtime.clock().Now());
      a_.module.row.Publish({std::vector<double>(size, ++last)});
    }
    WaitUntil("it has come", [&] {
      const auto read = b_.module.wanted.Read();
      return read.has_value() && read->values[0] == last;
    });
  };
  WaitUntil("a small one is sent after its cycle", [&] {
    publish(10);
    return a_.Text().find("after cycles") != std::string::npos;
  });
  publish(5000);  // this one has not been expected
  const auto after_cycles = [&] {
    const std::string text = a_.Text();
    return text.substr(text.find('('), text.find(')') - text.find('('));
  };
  const std::string before = after_cycles();
  for (int i = 0; i < 10; ++i) publish(i % 2 == 0 ? 5000 : 10);
  EXPECT_EQ(after_cycles(), before);
}

TEST_F(AfterCycleSending, ACycleDoesNotWaitForWhoIsSendingAndItsValueIsSentNext) {
  for (const ValueQuality quality : {ValueQuality::kNewest, ValueQuality::kEach}) {
    SCOPED_TRACE(static_cast<int>(quality));
    Gate gate;
    GatedEngine engine(MakeFakeWire(), gate);
    Member a(engine, "a");
    Member b(engine, "b");
    a.Offer({.port = "/application/module/place",
             .topic = "/place",
             .quality = quality,
             .sending = ValueSending::kAfterCycle});
    b.Take({.topic = "/place"}, b.module.goal);
    a.Begin();
    b.Begin();
    WaitUntil("it is read", [&] { return IsConnected(a.module.place); });
    a.module.place.Publish({1, 0});
    WaitUntil("it has come", [&] { return b.module.goal.Get().x == 1; });
    gate.Close();
    const int arrived = gate.arrived();
    a.module.place.Publish({2, 0});
    WaitUntil("the network's thread is sending it", [&] { return gate.arrived() > arrived; });
    {
      const OneCycle cycle(a.runtime.clock().Now());
      a.module.place.Publish({3, 0});
    }
    EXPECT_EQ(gate.arrived(), arrived + 1);
    gate.Open();
    WaitUntil("the last has come", [&] { return b.module.goal.Get().x == 3; });
  }
}

// Who stops the robot waits for nobody; nor does the safe value wait for the network's thread, which may wait for a lock.
TEST_F(AfterCycleSending, AStopThatFindsAnotherThreadSendingIsSentInTheSameTurn) {
  std::vector<OfferBell::By> sent;
  OfferBell bell(std::make_shared<WakeEvent>(), [&](OfferBell::By by) {
    sent.push_back(by);
    gate_.Pass();
  });
  gate_.Close();
  std::thread sender([&] { bell.SendByNetwork(); });
  WaitUntil("it is sending", [&] { return gate_.arrived() == 1; });
  bell.SendStop();
  gate_.Open();
  sender.join();
  EXPECT_THAT(sent, testing::ElementsAre(OfferBell::By::kNetwork, OfferBell::By::kStop));
}

TEST_F(AfterCycleSending, AnOfferThatEndsWaitsForACycleThatIsSending) {
  Begin();
  SendFirst();
  int last = 0;
  WaitUntil("values are sent after cycles", [&] {
    PublishInCycle(++last);
    return Count("after cycles") > 0;
  });
  gate_.Close();
  const int arrived = gate_.arrived();
  std::thread cycle([&] { PublishInCycle(++last); });
  WaitUntil("it is being sent", [&] { return gate_.arrived() > arrived; });
  std::atomic<bool> has_ended{false};
  std::thread end([&] {
    a_.End();
    has_ended = true;
  });
  EXPECT_FALSE(has_ended);
  gate_.Open();
  cycle.join();
  end.join();
}

TEST_F(AfterCycleSending, NoValueOvertakesAnotherWhicheverWayTheyGo) {
  Begin();
  SendFirst();
  constexpr int kCount = 20'000;
  std::atomic<bool> has_gone_back{false};
  std::jthread reader([&] {
    double last = 0;
    YieldUntil("the newest has come", [&] {
      const double x = b_.module.goal.Get().x;
      if (x < last) has_gone_back = true;
      last = x;
      return x == kCount;
    });
  });
  for (int i = 1; i <= kCount; ++i) {
    if (i % 3 == 0) {
      PublishOutside(i);
    } else {
      PublishInCycle(i);
    }
  }
  reader.join();
  EXPECT_FALSE(has_gone_back);
}

TEST_F(AfterCycleSending, OfAQueueEachValueComesInItsOrderWhicheverWayTheyGo) {
  Begin(ValueQuality::kEach);
  SendFirst();
  ProbePort all(b_.runtime.root(), "all", TypeOf<Place>());
  ASSERT_TRUE(Port::Connect(*b_.network->takes().front().output, all));
  while (all.Take([](const void*, ValueTimes) {})) {
  }
  double expected = 0;
  for (int round = 0; round < 100; ++round) {
    const int first = round * 60;
    for (int i = first + 1; i <= first + 60; ++i) {
      if (i % 5 == 4) {  // the last of a round is of a cycle
        PublishOutside(i);
      } else {
        PublishInCycle(i);
      }
    }
    WaitUntil("all have come", [&] {
      while (all.Take(
          [&](const void* value, ValueTimes) { EXPECT_EQ(static_cast<const Place*>(value)->x, ++expected); })) {
      }
      return expected >= first + 60;
    });
  }
  EXPECT_THAT(a_.Text(), Not(HasSubstr("lost")));
}

TEST_F(AfterCycleSending, WhatIsTooMuchForOneCycleIsSentByTheNetworksThread) {
  Begin(ValueQuality::kEach);
  SendFirst();
  ProbePort all(b_.runtime.root(), "all", TypeOf<Place>());
  ASSERT_TRUE(Port::Connect(*b_.network->takes().front().output, all));
  int count = 0;
  while (all.Take([](const void*, ValueTimes) {})) {
  }
  {
    const OneCycle cycle(a_.runtime.clock().Now());
    for (int i = 1; i <= 100; ++i) a_.module.place.Publish({1.0 * i, 0});
  }
  WaitUntil("all have come", [&] {
    while (all.Take([&](const void* value, ValueTimes) { EXPECT_EQ(static_cast<const Place*>(value)->x, ++count); })) {
    }
    return count >= 100;
  });
  EXPECT_LE(Count("after cycles"), 8);
}

TEST_F(AfterCycleSending, ModulesAndOffersChangeWhileCyclesRun) {
  Begin();
  SendFirst();
  std::atomic<int> published{0};
  const std::jthread cycles([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) PublishInCycle(++published);
  });
  const std::vector<OfferOptions> after = a_.network->options().offers;
  std::vector<OfferOptions> by_network = after;
  for (OfferOptions& each : by_network) each.sending = ValueSending::kNetwork;
  for (int i = 0; i < 20; ++i) {
    const auto set = [&](std::vector<OfferOptions> offers) {
      {
        const std::lock_guard lock(a_.runtime.structure_mutex());
        a_.network->set_offers(std::move(offers));
      }
      const double before = b_.module.goal.Get().x;
      WaitUntil("it goes on", [&] { return b_.module.goal.Get().x > before; });
    };
    set(by_network);
    set(after);
  }
  WaitUntil("it is sent after cycles", [&] { return a_.Text().find("after cycles") != std::string::npos; });
  a_.End();  // while values are published
  const int last = published;
  WaitUntil("cycles go on", [&] { return published > last + 100; });
}

// A module that takes the place of another begins to count anew.
TEST_F(AfterCycleSending, TheFirstValueOfAModuleInThePlaceOfAnotherIsSent) {
  Begin();
  SendFirst();
  PublishInCycle(1);
  ASSERT_TRUE(a_.runtime.Delete(a_.module));
  auto& again = a_.runtime.Create<Module1>(a_.group, "module");
  ASSERT_TRUE(a_.runtime.MakeReady(again));
  WaitUntil("it is read", [&] { return IsConnected(again.place); });
  for (int i = 2; i <= 5; ++i) {
    {
      const OneCycle cycle(a_.runtime.clock().Now());
      again.place.Publish({1.0 * i, 0});
    }
    WaitForPlace(i);
  }
}

TEST_F(AfterCycleSending, AnExecutorsThreadDoesIt) {
  Begin();
  std::atomic<int> updates{0};
  a_.module.action = [&](Module1& module) { module.place.Publish({1.0 * ++updates, 0}); };
  Scheduler scheduler(a_.runtime, {.clock = SchedulerOptions::ClockKind::kReal});
  const auto started = scheduler.Start();
  ASSERT_TRUE(started) << started.error().ToString();
  WaitUntil("some have come", [&] { return b_.module.goal.Get().x >= 20; });
  WaitUntil("they are sent after cycles", [&] { return a_.Text().find("after cycles") != std::string::npos; });
  scheduler.Stop();
  WaitForPlace(updates);
}

}  // namespace
}  // namespace runnel::test
