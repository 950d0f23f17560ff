// What becomes of faults while memory, or a thread, is short: none is lost, answered twice, or in the way of others.

#include <atomic>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/scheduling/fault_dispatcher.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/wait_until.h"

namespace runnel {
namespace {

using test::FaultInjection;
using test::InjectedFault;
using ::testing::SizeIs;
using testing::TakeAll;

TEST(FaultsWithoutMemory, EndTheRunAllTheSame) {
  FaultDispatcher faults;
  faults.AddRule({.of = "/robot"});
  auto record = std::make_unique<FaultRecord>("/robot/laser");
  record->Fill("no answer", At(10), 1);
  faults.Raise(std::move(record));
  FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
  EXPECT_FALSE(faults.Dispatch()) << "it is not told";
  injection.End();
  EXPECT_TRUE(faults.stop_requested());
  EXPECT_TRUE(faults.Dispatch());
  EXPECT_THAT(TakeAll(faults), SizeIs(1));
}

// Whatever is in front of it.
TEST(FaultsWithoutMemory, EndTheRunBehindOthers) {
  for (const bool is_stuck : {false, true}) {
    FaultDispatcher faults;
    faults.AddRule({.of = "/robot/base", .call = [](const Fault&) {}, .ends_run = !is_stuck});
    faults.Raise(std::make_unique<FaultRecord>(
        Fault{.path = "/robot/a_laser_of_a_long_name", .message = "stuck", .kind = Fault::Kind::kStuck},
        [](const Fault&) {}));
    faults.Raise(std::make_unique<FaultRecord>(
        Fault{.path = "/robot/base", .message = "no", .kind = is_stuck ? Fault::Kind::kStuck : Fault::Kind::kThrown},
        [](const Fault&) {}, is_stuck));
    const FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
    EXPECT_FALSE(faults.Dispatch());
    EXPECT_TRUE(faults.stop_requested()) << is_stuck;
  }
}

TEST(FaultsWithoutMemory, AreAnsweredInTheirOrder) {
  FaultDispatcher faults;
  std::vector<std::string> order;
  order.reserve(10);
  std::optional<FaultInjection> injection;
  const auto make = [&](Fault::Kind kind, const char* name) {
    return std::make_unique<FaultRecord>(Fault{.path = "/robot/a", .message = name, .kind = kind},
                                         [&order, name](const Fault&) { order.emplace_back(name); });
  };
  auto third = make(Fault::Kind::kStuck, "third");
  faults.Raise(std::make_unique<FaultRecord>(Fault{.path = "/a", .message = "first", .kind = Fault::Kind::kStuck},
                                             [&](const Fault&) {
                                               order.emplace_back("first");
                                               faults.Raise(std::move(third));
                                               injection.emplace(InjectedFault::kAllocation, 1, 10);
                                             }));
  faults.Raise(make(Fault::Kind::kReturned, "second"));
  EXPECT_FALSE(faults.Dispatch());
  injection.reset();
  EXPECT_TRUE(faults.Dispatch());
  EXPECT_EQ(order, (std::vector<std::string>{"first", "second", "third"}));
}

// Of two that are mended by threads of their own the second one waits for the first without a lock.
TEST(FaultsWithoutMemory, AreMendedByAThreadOrLater) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    FaultDispatcher faults;
    faults.SetActsBeside(true);
    std::atomic<bool> goes_on{false};
    faults.SetHandler([&](const Fault&) -> FaultDispatcher::Action {
      return [&] {
        while (!goes_on) std::this_thread::yield();
        return std::string("it has been mended by what was returned");
      };
    });
    const auto raise = [&](const char* path) {
      auto record = std::make_unique<FaultRecord>(path);
      record->Fill("does not answer, and that is a longer text", At(10), 1);
      faults.Raise(std::move(record));
    };
    raise("/robot/a");
    EXPECT_TRUE(faults.Dispatch());
    raise("/robot/b");
    FaultInjection injection(InjectedFault::kAllocation, nth);
    (void)faults.Dispatch();
    injection.End();
    EXPECT_TRUE(faults.Dispatch());
    goes_on = true;
    faults.SetActsBeside(false);
    EXPECT_THAT(TakeAll(faults), SizeIs(2));
    if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
  }
}

// What has been handed to a thread is not lost with it.
TEST(FaultsWithoutMemory, AreDueAgainIfTheirThreadHasNone) {
  FaultDispatcher faults;
  faults.SetActsBeside(true);
  faults.AddRule({.of = "/robot"});
  std::atomic<int> tries{0};
  faults.SetHandler([&](const Fault&) -> FaultDispatcher::Action {
    return [&]() -> std::string {
      if (++tries < 3) throw std::bad_alloc();
      return "it has been put back";
    };
  });
  auto record = std::make_unique<FaultRecord>("/robot/laser");
  record->Fill("does not answer, and that is a longer text", At(10), 1);
  faults.Raise(std::move(record));
  test::WaitUntil("it has been mended", [&] { return faults.Dispatch() && tries == 3; });
  faults.SetActsBeside(false);
  const auto told = TakeAll(faults);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_TRUE(told[0].is_mended);
  EXPECT_FALSE(faults.stop_requested());
}

// The rule behind it waits for memory; it does not itself.
TEST(FaultsWithoutMemory, ARuleThatFailsIsNotAppliedAgain) {
  FaultDispatcher faults;
  std::optional<FaultInjection> injection;
  int first = 0, second = 0;
  faults.AddRule({.of = "/robot", .call = [&](const Fault&) {
                    ++first;
                    injection.emplace(InjectedFault::kAllocation, 1, 1000);
                    throw 7;
                  }});
  faults.AddRule({.of = "/robot/of_a_path_that_is_long", .call = [&](const Fault&) { ++second; }});
  auto record = std::make_unique<FaultRecord>("/robot/of_a_path_that_is_long");
  record->Fill("no", At(10), 1);
  faults.Raise(std::move(record));
  EXPECT_FALSE(faults.Dispatch());
  injection.reset();
  EXPECT_TRUE(faults.Dispatch());
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
  EXPECT_THAT(TakeAll(faults), SizeIs(1));
}

TEST(FaultsWithoutMemory, EndNoRunThatTheirHandlerLetsGoOn) {
  FaultDispatcher faults;
  faults.AddRule({.of = "/robot"});
  faults.SetHandler([](const Fault&) -> FaultDispatcher::Action {
    return [] { return std::string("has been put back, which is a longer text"); };
  });
  for (const char* const path : {"/robot/laser_of_a_long_name", "/robot/planner_of_a_long_name"}) {
    auto record = std::make_unique<FaultRecord>(path);
    record->Fill("no", At(10), 1);
    faults.Raise(std::move(record));
  }
  FaultInjection injection(InjectedFault::kAllocation, 1);
  EXPECT_FALSE(faults.Dispatch());
  injection.End();
  EXPECT_TRUE(faults.Dispatch());
  EXPECT_FALSE(faults.stop_requested());
  EXPECT_THAT(TakeAll(faults), SizeIs(2));
}

// A rule that has been applied is not applied to what is mended after all, nor the handler asked again.
TEST(FaultsWithoutMemory, StayWithTheRulesOnceTheirHandlerHasDeclined) {
  FaultDispatcher faults;
  std::optional<FaultInjection> injection;
  int asked = 0, first = 0, second = 0;
  faults.SetHandler([&](const Fault&) -> FaultDispatcher::Action {
    return ++asked == 1 ? FaultDispatcher::Action() : [] { return std::string("put back"); };
  });
  faults.AddRule(
      {.of = "/", .call = [&](const Fault&) { ++first, injection.emplace(InjectedFault::kAllocation, 1, 1000); }});
  faults.AddRule({.of = "/robot/of_a_path_that_is_long", .call = [&](const Fault&) { ++second; }, .ends_run = true});
  auto record = std::make_unique<FaultRecord>("/robot/of_a_path_that_is_long");
  record->Fill("no", At(10), 1);
  faults.Raise(std::move(record));
  EXPECT_FALSE(faults.Dispatch());
  EXPECT_TRUE(faults.stop_requested());
  injection.reset();
  EXPECT_TRUE(faults.Dispatch());
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
  EXPECT_THAT(TakeAll(faults), SizeIs(1));
}

// Each rule has its time, and the run ends where one says so that never has memory.
TEST(FaultsWithoutMemory, ARuleThatEndsTheRunDoesSoWithoutAny) {
  FaultDispatcher faults;
  faults.SetHandler([](const Fault&) { return FaultDispatcher::Action(); });
  int tries = 0;
  faults.AddRule({.of = "/robot", .call = [](const Fault&) { throw std::bad_alloc(); }});
  faults.AddRule({.of = "/robot", .call = [&](const Fault&) {
                    if (++tries == 1) throw std::bad_alloc();
                  }});
  faults.AddRule({.of = "/robot", .call = [](const Fault&) { throw 7; }, .ends_run = true});
  faults.Report({.path = "/robot/laser", .message = "no"});
  test::WaitUntil("all have been applied", [&] { return faults.Dispatch(); });
  EXPECT_EQ(tries, 2);
  EXPECT_TRUE(faults.stop_requested());
}

// What only says that it has no memory is not waited for without end, nor does it keep up others.
TEST(FaultsWithoutMemory, ARuleThatNeverHasSomeFailsAfterAWhile) {
  FaultDispatcher faults;
  int second = 0;
  faults.AddRule({.of = "/robot", .call = [](const Fault&) { throw std::bad_alloc(); }});
  faults.AddRule({.of = "/robot", .call = [&](const Fault&) { ++second; }});
  faults.Report({.path = "/robot/laser", .message = "no"});
  test::WaitUntil("the other rule has been applied", [&] { return faults.Dispatch(); });
  EXPECT_EQ(second, 1);
  EXPECT_THAT(TakeAll(faults), SizeIs(2));
}

// All that wait are overdue together: one that nothing mends is in front of others for no longer.
TEST(FaultsWithoutMemory, ThoseBehindWaitForNoMoreThanTheFirst) {
  FaultDispatcher faults;
  int asked_of_second = 0, applied = 0;
  faults.SetHandler([&](const Fault& fault) -> FaultDispatcher::Action {
    asked_of_second += fault.path == "/second";
    throw std::bad_alloc();
  });
  faults.AddRule({.call = [&](const Fault&) { ++applied; }});
  for (const char* const path : {"/first", "/second"}) {
    faults.Raise(std::make_unique<FaultRecord>(Fault{.path = path, .message = "no"}, nullptr));
  }
  test::WaitUntil("all have been answered to", [&] { return faults.Dispatch(); });
  EXPECT_EQ(asked_of_second, 1);
  EXPECT_EQ(applied, 2);
}

// The time of a reaction begins when it is tried.
TEST(FaultsWithoutMemory, AReactionBehindOneThatFailsIsTriedAgain) {
  for (const bool is_stuck : {false, true}) {
    FaultDispatcher faults;
    int tries = 0;
    const auto react = [&](const Fault&) {
      if (++tries == 1) throw std::bad_alloc();
    };
    faults.AddRule({.of = "/first", .call = [](const Fault&) { throw std::bad_alloc(); }});
    if (!is_stuck) faults.AddRule({.of = "/motor", .call = react});
    faults.Raise(std::make_unique<FaultRecord>(Fault{.path = "/first", .message = "no"}, nullptr));
    faults.Raise(std::make_unique<FaultRecord>(
        Fault{.path = "/motor", .message = "no", .kind = is_stuck ? Fault::Kind::kStuck : Fault::Kind::kThrown},
        react));
    test::WaitUntil("all have been answered to", [&] { return faults.Dispatch(); });
    EXPECT_EQ(tries, 2);
    EXPECT_THAT(TakeAll(faults), SizeIs(3)) << "two faults, and a rule that has failed";
  }
}

// What the handler has waited for is not taken from the time of what it has returned.
TEST(FaultsWithoutMemory, WhatMendsOneHasATimeOfItsOwn) {
  FaultDispatcher faults;
  int asked = 0, tries = 0;
  faults.SetHandler([&](const Fault&) -> FaultDispatcher::Action {
    if (++asked == 1) throw std::bad_alloc();
    return [&] {
      if (++tries > 1) return std::string("it has been put back");
      std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // longer than it may be without memory
      throw std::bad_alloc();
    };
  });
  faults.Raise(std::make_unique<FaultRecord>(Fault{.path = "/robot", .message = "no"}, nullptr));
  test::WaitUntil("it has been answered to", [&] { return faults.Dispatch(); });
  const auto told = TakeAll(faults);
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_TRUE(told[0].is_mended);
}

}  // namespace
}  // namespace runnel
