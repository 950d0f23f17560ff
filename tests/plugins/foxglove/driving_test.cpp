// Clients that publish to what something moves by: whoever is not heard of any more drives no longer.

#include <algorithm>

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::Pair;

class Base final : public Module {
 public:
  using Module::Module;
  Input<double> wheels{this, "wheels", {.unit = "m/s", .drives = true}};
  Input<double> lift{
      this, "lift", {.limits = {.default_value = 0.2}, .drives = true, .command = DrivingKind::kPosition}};

 private:
  void Update() override {}
};

class FoxgloveDriving : public FoxgloveTest {
 protected:
  FoxgloveDriving() { EXPECT_TRUE(runtime.MakeReady(base)); }
  ~FoxgloveDriving() override { session = nullptr; }

  void Advertise(std::uint32_t id, const std::string& topic) {
    Say({{"op", "advertise"},
         {"channels", {{{"id", id}, {"topic", topic}, {"encoding", "json"}, {"schemaName", "any"}}}}});
  }
  bool Reads(const Input<double>& input, double wanted) {
    return Wait([&] { return input.Get() == wanted; });
  }
  std::size_t Brought() {  // by clients
    const std::lock_guard lock(runtime.structure_mutex());
    return runtime.root().children().size() - 1;
  }
  auto Hands() { return service.hand_settings().All(); }
  bool IsLost() {
    const auto hands = Hands();
    return !hands.empty() && hands.begin()->second == HandState::kLost;
  }
  /// The worker has something else to do as long as this lives.
  struct Busy {
    explicit Busy(CommandService& service) : tasks(service.worker()) {
      tasks.Post([this] {
        has_begun.release();
        may_end.acquire();
      });
      has_begun.acquire();
    }
    ~Busy() { may_end.release(); }
    std::binary_semaphore has_begun{0};
    std::binary_semaphore may_end{0};
    TaskGroup tasks;
  };

  static constexpr const char* kWheels = "/application/base/input/wheels";
  Base& base = runtime.Create<Base>(application, "base");
};

TEST_F(FoxgloveDriving, IsByHandAndEndsWithTheChannel) {
  Begin();
  Advertise(1, "/base/wheels");
  Publish(1, "0.3");
  EXPECT_TRUE(Reads(base.wheels, 0.3));
  EXPECT_TRUE(Wait([&] { return !Hands().empty(); }));  // it is told just after
  EXPECT_THAT(Hands(), ElementsAre(Pair(kWheels, HandState::kDriven)));
  Publish(1, R"({"value": 0.25})");
  EXPECT_TRUE(Reads(base.wheels, 0.25));
  Publish(1, "fast");
  EXPECT_THAT(Complaint(), HasSubstr(kWheels));
  Say({{"op", "unadvertise"}, {"channelIds", {1}}});
  EXPECT_TRUE(Reads(base.wheels, 0));
  EXPECT_TRUE(Wait([&] { return IsLost(); }));
  EXPECT_THAT(Hands(), ElementsAre(Pair(kWheels, HandState::kLost)));
  EXPECT_THAT(log.ReadEntries(0, 99).entries.back().text,
              HasSubstr("who drove it has left; it is at rest until it is released"));
  EXPECT_EQ(Complaint(), "");
}

TEST_F(FoxgloveDriving, EndsWithTheConnectionWhoeverHasTheStructureAndTheWorker) {
  Begin();
  Advertise(1, "/base/wheels");
  Advertise(2, "/base/lift");
  Publish(1, "0.3");
  Publish(2, "0.7");
  ASSERT_TRUE(Reads(base.wheels, 0.3));
  ASSERT_TRUE(Reads(base.lift, 0.7));
  const Busy busy(service);
  const HeldStructure held(runtime);
  session = nullptr;
  WaitUntil("it is at rest", [&] { return base.wheels.Get() == 0 && base.lift.Get() == 0.2; });
}

TEST_F(FoxgloveDriving, EndsWithTheConnectionWhereMemoryIsShort) {
  Begin();
  Advertise(1, "/base/wheels");
  Advertise(2, "/robot/limit");
  Publish(1, "0.3");
  ASSERT_TRUE(Reads(base.wheels, 0.3));
  ASSERT_TRUE(Wait([&] { return Brought() == 1; }));
  {
    const FaultInjection short_of_memory(InjectedFault::kAllocation, 1, 20);
    session = nullptr;
  }
  WaitUntil("it is at rest", [&] { return base.wheels.Get() == 0; });
  WaitUntil("nothing is left behind", [&] { return Brought() == 0; });
}

TEST_F(FoxgloveDriving, TheEndTakesAwayWhatTheWorkerHadNoTimeForWhereMemoryIsShort) {
  Begin();
  Advertise(1, "/robot/limit");
  ASSERT_TRUE(Wait([&] { return Brought() == 1; }));
  const Busy busy(service);
  session = nullptr;
  {
    const FaultInjection short_of_memory(InjectedFault::kAllocation, 1, 20);
    protocol = {};
  }
  EXPECT_EQ(Brought(), 0u);
}

TEST_F(FoxgloveDriving, WhoIsSilentDrivesNoLongerUntilHeSaysSomethingAnew) {
  drive_deadline = 50ms;
  Begin();
  Advertise(1, "/base/wheels");
  Publish(1, "0.3");
  ASSERT_TRUE(Wait([&] { return !Hands().empty(); })) << Complaint();
  EXPECT_TRUE(Reads(base.wheels, 0));
  EXPECT_TRUE(Wait([&] { return IsLost(); }));
  EXPECT_THAT(Hands(), ElementsAre(Pair(kWheels, HandState::kLost)));
  Publish(1, "0.2");
  EXPECT_TRUE(Wait([&] {
    const auto entries = log.ReadEntries(0, 99).entries;
    return std::ranges::any_of(
        entries, [](const auto& each) { return each.text.starts_with("publish /application/base/input/wheels 0.2"); });
  }));
  EXPECT_TRUE(Reads(base.wheels, 0)) << "once more";
  EXPECT_EQ(Complaint(), "");
}

TEST_F(FoxgloveDriving, WhatIsReleasedIsNotTakenBackByAButtonThatIsHeld) {
  Begin();
  Advertise(1, "/base/wheels");
  Publish(1, "0.3");
  ASSERT_TRUE(Reads(base.wheels, 0.3));
  TaskGroup tasks(service.worker());
  const auto release = service.Begin(ReleaseRequest{kWheels}, tasks);
  WaitUntil("it is released", [&] { return release->is_done(); });
  EXPECT_EQ(Complaint(), "");
  Publish(1, "0.3");
  std::string complaint;
  EXPECT_TRUE(Wait([&] { return !(complaint = Complaint()).empty(); }));
  EXPECT_THAT(complaint, HasSubstr("this hold has ended"));
  EXPECT_THAT(Hands(), IsEmpty());
}

TEST_F(FoxgloveDriving, NorIsWhatAStopHasEndedWhenItIsReleased) {
  Begin();
  Advertise(1, "/base/wheels");
  Publish(1, "0.3");
  ASSERT_TRUE(Reads(base.wheels, 0.3));
  runtime.robot_stop().Press("a test");
  ASSERT_TRUE(runtime.robot_stop().Release("a test"));
  Publish(1, "0.3");
  std::string complaint;
  EXPECT_TRUE(Wait([&] { return !(complaint = Complaint()).empty(); }));
  EXPECT_THAT(complaint, HasSubstr("STOP has ended this hold"));
  EXPECT_EQ(base.wheels.Get(), 0);
}

TEST_F(FoxgloveDriving, NothingIsDoneForWhoHasGoneMeanwhile) {
  Begin();
  Advertise(1, "/base/wheels");
  Publish(1, "0.1");
  ASSERT_TRUE(Reads(base.wheels, 0.1));
  {
    const Busy busy(service);
    Publish(1, "0.2");
    Publish(1, "0.3");
    EXPECT_EQ(base.wheels.Get(), 0.1);
  }
  EXPECT_TRUE(Reads(base.wheels, 0.3));
  {
    const Busy busy(service);
    Publish(1, "0.4");
    session = nullptr;
    WaitUntil("it is at rest", [&] { return base.wheels.Get() == 0; });
  }
  std::binary_semaphore has_run(0);
  TaskGroup tasks(service.worker());
  tasks.Post([&] { has_run.release(); });
  has_run.acquire();
  EXPECT_EQ(base.wheels.Get(), 0);
}

TEST_F(FoxgloveDriving, IsSoThroughTheInterfaceOfAGroup) {
  auto& group = runtime.Create<Group>(application, "group");
  auto& inner = runtime.Create<Base>(group, "inner");
  auto& way_in = runtime.Create<ProxyPort>(group, "lift", Port::Direction::kInput, TypeOf<double>());
  ASSERT_TRUE(runtime.MakeReady(group));
  ASSERT_TRUE(Port::Connect(way_in, inner.lift));
  Begin();
  Advertise(1, "/group/lift");
  Publish(1, "0.6");
  EXPECT_TRUE(Reads(inner.lift, 0.6));
  Say({{"op", "unadvertise"}, {"channelIds", {1}}});
  EXPECT_TRUE(Reads(inner.lift, 0.2)) << "the safe value of what is behind";
}

TEST_F(FoxgloveDriving, AChannelIsClosedWhenItsInputBeginsToDrive) {
  Begin();
  Advertise(1, "/robot/limit");
  Publish(1, "0.5");
  ASSERT_TRUE(Wait([&] { return robot.limit.Read() && *robot.limit.Read() == 0.5; }));
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(robot.limit.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kEffort));
  }
  std::string complaint;
  EXPECT_TRUE(Wait([&] { return !(complaint = Complaint()).empty(); }));
  EXPECT_THAT(complaint, HasSubstr("whether something moves by its input has changed; advertise it anew"));
  Advertise(1, "/robot/limit");
  Publish(1, "0.4");
  EXPECT_TRUE(Reads(robot.limit, 0.4));
  EXPECT_TRUE(Wait([&] { return Hands().size() == 1; }));
}

}  // namespace
}  // namespace runnel::test
