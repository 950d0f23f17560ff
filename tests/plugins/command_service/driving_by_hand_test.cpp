// Deadlines of what is set by hand, at a port.

#include <future>
#include <memory>
#include <thread>

#include <gmock/gmock.h>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/type_builder.h"
#include "plugins/command_service/hand_settings.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

struct Motion {
  double forward = 0;
  double turn = 0;
  friend bool operator==(const Motion&, const Motion&) = default;
};
inline void Describe(TypeBuilder<Motion>& type) {
  type.Name("Motion").Field("forward", &Motion::forward).Field("turn", &Motion::turn);
}

namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class Planner final : public Module {
 public:
  using Module::Module;
  Output<Motion> motion{this, "motion"};

 private:
  void Update() override {}
};

class Base final : public Module {
 public:
  using Module::Module;
  Input<Motion> motion{this, "motion", {.limits = {.default_value = Motion{}}}};
  Input<double> height{this, "height", {.limits = {.default_value = 0.2, .minimum = 0.1}}};
  Input<double> sealed{this, "sealed", {.limits = {.minimum = 0.1}}};

 private:
  void Update() override {}
};

class DrivingByHand : public ::testing::Test {
 protected:
  DrivingByHand() {
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    EXPECT_TRUE(Port::Connect(planner.motion, base.motion));
    planner.motion.Publish({0.4, 0});
  }
  std::string Publish(HandSettings& by_hand, PublishRequest request) {
    const auto published = by_hand.Publish(request);
    return published ? "" : published.error().message;
  }
  std::string Drive(HandSettings& by_hand, const char* value, const char* lease = "a") {
    return Publish(by_hand, {kMotion, value, {}, Duration(250ms), lease});
  }
  Motion Read() { return base.motion.Get(); }

  static constexpr const char* kMotion = "/base/input/motion";

  Runtime runtime;
  Planner& planner = runtime.Create<Planner>(runtime.root(), "planner");
  Base& base = runtime.Create<Base>(runtime.root(), "base");
  ApplicationLog log{runtime.clock()};
  CommandWorker worker;
  ManualClock machine;
};

TEST_F(DrivingByHand, ReadersFindARestingBaseWhenTheDeadlineHasPassed) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3, turn: 1}"), "");
  machine.Advance(200ms);
  EXPECT_EQ(Drive(by_hand, "{forward: 0.2}"), "");
  machine.Advance(249ms);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(Read(), (Motion{0.2, 0}));
  machine.Advance(1ms);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(Read(), Motion{});
  planner.motion.Publish({0.4, 0});
  EXPECT_EQ(Read(), Motion{}) << "the planner does not begin to drive by itself";
  EXPECT_THAT(by_hand.All(), ElementsAre(Pair(kMotion, HandState::kLost)));
  EXPECT_THAT(log.ReadEntries(0, 9).entries.back().text, HasSubstr("at rest until it is released"));
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}"), HasSubstr("this hold has ended"));
  EXPECT_EQ(Read(), Motion{});
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}", "b"), "");
  EXPECT_EQ(Read(), (Motion{0.3, 0}));
  EXPECT_TRUE(ReleasePort(runtime, kMotion));
  EXPECT_EQ(Read(), (Motion{0.4, 0}));
}

TEST_F(DrivingByHand, WhoDrivesMaySayThatHeHasLeft) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}"), "");
  by_hand.EndLease("b");
  by_hand.LookAtDeadlines();
  EXPECT_EQ(Read(), (Motion{0.3, 0})) << "somebody else";
  by_hand.EndLease("a");
  by_hand.LookAtDeadlines();
  EXPECT_EQ(Read(), Motion{});
  EXPECT_THAT(by_hand.All(), ElementsAre(Pair(kMotion, HandState::kLost)));
  EXPECT_THAT(log.ReadEntries(0, 9).entries.back().text,
              HasSubstr("who drove it has left; it is at rest until it is released"));
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}"), HasSubstr("this hold has ended"));
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}", "b"), HasSubstr("this hold has ended"))
      << "what is ended before it begins";
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}", "c"), "");
}

TEST_F(DrivingByHand, TheSafeValueOfAnInputIsItsDefault) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Publish(by_hand, {"/base/input/height", "3", {}, Duration(250ms)}), "");
  EXPECT_EQ(base.height.Get(), 3);
  machine.Advance(1s);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(base.height.Get(), 0.2);
}

TEST_F(DrivingByHand, WithoutASafeValueThereIsNoDeadline) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_THAT(Publish(by_hand, {"/base/input/sealed", "3", {}, Duration(250ms)}), HasSubstr("no safe value"));
  EXPECT_FALSE(base.sealed.is_set_by_hand());
  EXPECT_EQ(Publish(by_hand, {"/base/input/sealed", "3"}), "");
}

// The port that takes its place has the deadline, too.
TEST_F(DrivingByHand, ADeadlineGoesWithThePortThatTakesItsPlace) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}"), "");
  Base& next = runtime.Create<Base>(runtime.root(), "renamed");
  ASSERT_TRUE(runtime.MakeReady(next));
  {
    const std::lock_guard lock(runtime.structure_mutex());
    next.motion.TakeOver(base.motion);
    next.motion.InheritAnnotations(base.motion);
  }
  EXPECT_EQ(next.motion.Get(), (Motion{0.3, 0}));
  EXPECT_THAT(by_hand.All(), ElementsAre(Pair("/renamed/input/motion", HandState::kDriven)));
  machine.Advance(250ms);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(next.motion.Get(), Motion{});
  EXPECT_THAT(by_hand.All(), ElementsAre(Pair("/renamed/input/motion", HandState::kLost)));
  EXPECT_TRUE(ReleasePort(runtime, "/renamed/input/motion"));
  EXPECT_THAT(by_hand.All(), ::testing::IsEmpty());
}

// An undo makes the port again with what was set there: at rest, as nobody is heard of any more.
TEST_F(DrivingByHand, WhatADrivenPortLeavesBehindIsItsSafeValue) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Publish(by_hand, {kMotion, "{forward: 0.3}"}), "");
  const auto left = [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    return *static_cast<const Motion*>(base.motion.ValueByHand()->value.get());
  };
  EXPECT_EQ(left(), (Motion{0.3, 0}));
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}"), "");
  EXPECT_EQ(left(), Motion{});
  ASSERT_TRUE(base.motion.Release());
  EXPECT_THAT(by_hand.All(), ::testing::IsEmpty()) << "released behind its back";
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}"), HasSubstr("has ended"));
}

// A slow constructor, an editor that applies a thousand changes: whoever has the structure lock keeps nothing up.
TEST_F(DrivingByHand, ADeadlineWaitsForNoChangeOfTheStructure) {
  HandSettings by_hand(runtime, worker, log);
  EXPECT_EQ(Publish(by_hand, {kMotion, "{forward: 0.3}", {}, Duration(10ms)}), "");
  std::promise<void> begun;
  std::promise<void> may_end;
  std::thread change([&] {
    const std::lock_guard lock(runtime.structure_mutex());
    begun.set_value();
    may_end.get_future().wait();
  });
  begun.get_future().wait();
  EXPECT_EQ(Publish(by_hand, {kMotion, "{}", 1e-12}), "the rate must be from 0.001 to 1000 Hz");
  WaitUntil("the base is at rest", [&] { return Read() == Motion{}; });
  (void)by_hand.All();  // does not wait either
  may_end.set_value();
  change.join();
}

TEST_F(DrivingByHand, ABlockKeepsEverybodyElseOff) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}"), "");
  EXPECT_TRUE(by_hand.Block({kMotion}));
  EXPECT_THAT(by_hand.All(), ElementsAre(Pair(kMotion, HandState::kStopped)));
  EXPECT_EQ(Read(), Motion{});
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}", "b"), HasSubstr("blocked"));
  EXPECT_THAT(Publish(by_hand, {kMotion, "{forward: 0.3}"}), HasSubstr("blocked"));
  EXPECT_EQ(Read(), Motion{});
  machine.Advance(1h);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(Read(), Motion{});
  EXPECT_FALSE(ReleasePort(runtime, "")) << "the name is missing";
  EXPECT_TRUE(ReleasePort(runtime, kMotion));
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}"), HasSubstr("has ended")) << "who held it lets go first";
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}", "b"), "");
}

TEST_F(DrivingByHand, WhatIsReleasedBehindItsBackIsNotBlockedAnyMore) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_TRUE(by_hand.Block({kMotion}));
  EXPECT_TRUE(base.motion.Unblock());
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}"), "");
  EXPECT_EQ(Read(), (Motion{0.3, 0}));
}

TEST_F(DrivingByHand, ADeadlineMustMakeSense) {
  HandSettings by_hand(runtime, worker, log, &machine);
  const auto with = [&](Duration deadline) { return Publish(by_hand, {kMotion, "{forward: 0.3}", {}, deadline}); };
  EXPECT_THAT(with(Duration::zero()), HasSubstr("from 10ms to 60s"));
  EXPECT_THAT(with(2min), HasSubstr("from 10ms to 60s"));
  EXPECT_EQ(Read(), (Motion{0.4, 0})) << "nothing has been set";
}

// With the machine's clock, whose passing nobody here measures.
TEST_F(DrivingByHand, SomebodyLooksAtTheDeadlinesAllTheTime) {
  HandSettings by_hand(runtime, worker, log);
  EXPECT_EQ(Publish(by_hand, {kMotion, "{forward: 0.3}", {}, PublishRequest::kLongestDeadline}), "");
  EXPECT_EQ(Read(), (Motion{0.3, 0}));
  EXPECT_EQ(Publish(by_hand, {kMotion, "{turn: 1}", {}, PublishRequest::kShortestDeadline}), "");
  WaitUntil("the base is at rest", [&] { return Read() == Motion{}; });
  WaitUntil("it is said to be lost",
            [&] { return by_hand.All() == std::vector{std::pair(std::string(kMotion), HandState::kLost)}; });
}

// As a program in the process does.
TEST_F(DrivingByHand, AValueFromElsewhereEndsTheHoldOfBefore) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Publish(by_hand, {kMotion, "{forward: 0.3}", 1000, Duration(250ms), "a"}), "");
  EXPECT_TRUE(SetPortByHand(runtime, kMotion, "{forward: 0}"));
  EXPECT_THAT(by_hand.All(), ElementsAre(Pair(kMotion, HandState::kSet)));
  std::atomic<int> turns{0};
  TaskGroup tasks(worker);
  tasks.PostSteps(
      [&]() -> std::optional<Duration> { return ++turns < 5 ? std::optional<Duration>(10ms) : std::nullopt; });
  WaitUntil("the worker has had its turns", [&] { return turns == 5; });
  EXPECT_EQ(Read(), Motion{}) << "nothing of before is published again";
  EXPECT_TRUE(SetPortByHand(runtime, kMotion, "{forward: 0.2}"));
  machine.Advance(250ms);
  by_hand.LookAtDeadlines();
  EXPECT_EQ(Read(), (Motion{0.2, 0})) << "nor is there a deadline";
  EXPECT_THAT(Drive(by_hand, "{forward: 0.3}"), HasSubstr("ended")) << "what comes of the hold of before";
  EXPECT_EQ(Drive(by_hand, "{forward: 0.3}", "b"), "");
}

// Else the value of a hold that has ended came again after the safe one.
TEST_F(DrivingByHand, NothingIsPublishedAgainAfterTheDeadline) {
  HandSettings by_hand(runtime, worker, log, &machine);
  EXPECT_EQ(Publish(by_hand, {kMotion, "{forward: 0.3}", 1000, Duration(250ms), "a"}), "");
  const auto published = [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    return base.motion.ShownPorts().at(0)->publications();
  };
  WaitUntil("it is published again and again", [&] { return published() > 3; });
  machine.Advance(250ms);
  by_hand.LookAtDeadlines();
  const auto at_rest = published();
  // The worker has had its turn: whatever it was to publish again it has.
  std::atomic<int> turns{0};
  TaskGroup tasks(worker);
  tasks.PostSteps(
      [&]() -> std::optional<Duration> { return ++turns < 5 ? std::optional<Duration>(10ms) : std::nullopt; });
  WaitUntil("some turns of the worker", [&] { return turns >= 5; });
  EXPECT_EQ(published(), at_rest);
  EXPECT_EQ(Read(), Motion{});
}

}  // namespace
}  // namespace runnel::test
