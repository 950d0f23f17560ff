// Networks of behaviours, wherever memory runs out or a behaviour throws: they are changed, loaded and loaded anew as a whole or
// not at all, and what a STOP holds stays held.

#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string>

#include "plugins/structure/change_history.h"
#include "tests/support/faulty_operation.h"

extern "C" void InjectionPointForPlugins() { runnel::test::InjectionPoint(); }

namespace runnel::test {
namespace {

// Two that want a number each, of which a fusion makes the speed of the wheels: 2 of 1 and 3.
constexpr const char* kNetwork = R"(<application name="robot">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
  <load plugin="behaviours"/> <load plugin="wishes"/>
  <group name="network" characteristic="fusion">
    <port name="stimulation" direction="input"/> <port name="inhibition1" direction="input"/>
    <port name="activity" direction="output"/> <port name="target_rating" direction="output"/>
    <port name="out" direction="output" type="double"/>
    <module name="drive" type="wishes/wisher"> <parameter name="stimulation_mode" value="enabled"/> </module>
    <module name="avoid" type="wishes/wisher"> <parameter name="wanted" value="3"/> </module>
    <module name="fusion" type="behaviours/fusion"> <parameter name="stimulation_mode" value="enabled"/> </module>
    <connect from="drive/activity" to="avoid/stimulation fusion/activity1"/>
    <connect from="drive/target_rating" to="fusion/target_rating1"/> <connect from="drive/wish" to="fusion/in1"/>
    <connect from="avoid/activity" to="fusion/activity2"/>
    <connect from="avoid/target_rating" to="fusion/target_rating2"/> <connect from="avoid/wish" to="fusion/in2"/>
    <connect from="stimulation" to="fusion/stimulation"/> <connect from="inhibition1" to="fusion/inhibition1"/>
    <connect from="fusion/activity" to="activity"/> <connect from="fusion/target_rating" to="target_rating"/>
    <connect from="fusion/out" to="out"/>
    <never active="avoid" inactive="drive"/>
  </group>
  <module name="wheels" type="wishes/wheels"/>
  <connect from="network/out" to="wheels/speed"/>
  <driving port="wheels/speed" safe="0" command="velocity"/>
</application>
)";

const std::string kDrive = "/robot/network/drive", kAvoid = "/robot/network/avoid", kFusion = "/robot/network/fusion";

LoadedApplication LoadNetwork() {
  return Application::LoadText(kNetwork, {.plugin_folders = {RUNNEL_TEST_WISHES_FOLDER, RUNNEL_TEST_PLUGIN_FOLDER}});
}

double SpeedOf(Application& application) {
  const auto speed = application.Read<double>("/robot/wheels/turned");
  EXPECT_TRUE(speed) << speed.error().ToString();
  return speed ? speed->value_or(-1.0) : -1.0;
}

std::unique_ptr<Application> MakeNetwork() {
  auto loaded = LoadNetwork();
  EXPECT_TRUE(loaded) << loaded.diagnostics().ToString();
  if (!loaded) return nullptr;
  EXPECT_TRUE(loaded->RunCycles(10));
  EXPECT_DOUBLE_EQ(SpeedOf(*loaded), 2.0);
  return loaded.Take();
}

// Those that have failed since, and nothing has taken the place of.
std::set<std::string> TakeFailed(Application& application) {
  std::set<std::string> failed;
  for (const ApplicationEvent& each : application.TakeEvents()) {
    const bool has_failed = each.fault && each.fault->kind == Fault::Kind::kThrown && !each.fault->is_mended;
    if (has_failed) failed.insert(each.fault->path);
  }
  return failed;
}

// A STOP is in force: it holds the wheels until it is released.
void ExpectItDrives(Application& application, double speed) {
  EXPECT_TRUE(application.RunCycles(10));
  EXPECT_EQ(SpeedOf(application), 0.0);
  EXPECT_TRUE(application.runtime().robot_stop().Release("a test"));
  EXPECT_TRUE(application.RunCycles(10));
  EXPECT_DOUBLE_EQ(SpeedOf(application), speed);
  EXPECT_TRUE(TakeFailed(application).empty());
}

std::unique_ptr<Application> MakeChanged(const ChangeSet& changes) {
  auto application = MakeNetwork();
  if (application == nullptr) return nullptr;
  const auto outcome = application->Apply(changes);
  EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_TRUE(application->RunCycles(2));
  return application;
}

/// The robot drives at `speed` then.
FaultyOperation Changes(ChangeSet changes, double speed, const ChangeSet& before = {}) {
  return {.make = [before] { return before.empty() ? MakeNetwork() : MakeChanged(before); },
          .carry_out = [changes](Application& application) { return application.Apply(changes).ToResult(); },
          .prove = [speed](Application& application) { ExpectItDrives(application, speed); },
          .faults = {InjectedFault::kAllocation, InjectedFault::kException, InjectedFault::kNumber}};
}

const std::string kWall = "/robot/network/wall";
const ChangeSet kAdd{CreateModule{kWall, "wishes/wisher", {{"wanted", "5"}, {"inhibitions", "2"}}},
                     SetParameter{kFusion + "/channels", "3"},
                     ConnectPorts{kDrive + "/half", kWall + "/stimulation"},
                     ConnectPorts{kWall + "/activity", kFusion + "/activity3"},
                     ConnectPorts{kWall + "/target_rating", kFusion + "/target_rating3"},
                     ConnectPorts{kWall + "/wish", kFusion + "/in3"}};
const ChangeSet kDelete{SetParameter{kFusion + "/channels", "1"}, DeleteElement{kAvoid}};
const ChangeSet kSwap{ReplaceModule{kAvoid, "wishes/other", {{"wanted", "5"}}}};
const ChangeSet kSwapFusion{ReplaceModule{kFusion, "behaviours/fusion", {{"method", "winner_takes_all"}}}};
const ChangeSet kInhibit{ConnectPorts{kDrive + "/activity", kAvoid + "/inhibition1"}};
const ChangeSet kCrowd{CreateModule{"/robot/crowd", "wishes/crowd", {{"stimulation_mode", "enabled"}}}};

// With a channel more of the fusion, which is made anew for it: (1 + 3 + 5 / 2) / 2.5.
TEST(NetworkFaults, ABehaviourIsAddedOrNot) { EXPECT_GT(Endure(Changes(kAdd, 2.6)), 100u); }
TEST(NetworkFaults, ABehaviourIsDeletedOrNot) { EXPECT_GT(Endure(Changes(kDelete, 1.0)), 100u); }
TEST(NetworkFaults, ABehaviourIsSwappedOrNot) { EXPECT_GT(Endure(Changes(kSwap, 3.0)), 100u); }
TEST(NetworkFaults, AFusionIsSwappedOrNot) { EXPECT_GT(Endure(Changes(kSwapFusion, 1.0)), 100u); }
TEST(NetworkFaults, ABehaviourIsInhibitedOrNot) { EXPECT_GT(Endure(Changes(kInhibit, 1.0)), 10u); }
TEST(NetworkFaults, ABehaviourIsStimulatedNoMoreOrStill) {
  EXPECT_GT(Endure(Changes({DisconnectPorts{kDrive + "/activity", kAvoid + "/stimulation"}}, 1.0)), 10u);
}

TEST(NetworkFaults, AGroupThatIsABehaviourIsMadeOrNot) { EXPECT_GT(Endure(Changes(kCrowd, 2.0)), 100u); }
TEST(NetworkFaults, AGroupThatIsABehaviourIsReplacedOrNot) {
  EXPECT_GT(Endure(Changes({ReplaceModule{"/robot/crowd", "wishes/crowd"}}, 2.0, kCrowd)), 100u);
}
TEST(NetworkFaults, AGroupThatIsABehaviourIsDeletedOrNot) {
  EXPECT_GT(Endure(Changes({DeleteElement{"/robot/crowd"}}, 2.0, kCrowd)), 10u);
}

// All that the library has made, the wheels among it.
TEST(NetworkFaults, ALibraryOfBehavioursIsLoadedAnewOrNot) {
  FaultyOperation reload = Changes({}, 2.0);
  reload.carry_out = [](Application& application) { return application.Reload("wishes").ToResult(); };
  EXPECT_GT(Endure(reload), 100u);
}

// With its tags and checks. At few points, as it is large, and each time stays in memory.
TEST(NetworkFaults, TheLibraryOfFusionsIsLoadedAnewOrNot) {
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck && !HasFailure(); nth *= 2) {
    SCOPED_TRACE(nth);
    const auto application = MakeNetwork();
    (void)application->runtime().robot_stop().Press("a test");
    const std::string before = PictureOf(*application, true);
    ChangeOutcome outcome;
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      outcome = application->Reload("behaviours");
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    has_struck = injection.has_struck();
    EXPECT_TRUE(outcome || has_struck) << outcome.diagnostics.ToString();
    if (!outcome) {
      EXPECT_EQ(PictureOf(*application, true), before);
      outcome = application->Reload("behaviours");
      EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
    }
    ExpectItDrives(*application, 2.0);
  }
}

// Not by Endure(): an undo that is refused is forgotten, and the history says so.
void EndureUndo(const ChangeSet& changes) {
  const auto undo = [](Application& application) -> Result<void> {
    try {
      return application.Undo().ToResult();
    } catch (const std::bad_alloc&) {
      return Error{.message = "out of memory"};
    }
  };
  const auto make = [&] {
    auto application = MakeChanged(changes);
    (void)application->runtime().robot_stop().Press("a test");
    return application;
  };
  std::string undone;
  {
    const auto application = make();  // and what the process does once
    const auto outcome = undo(*application);
    ASSERT_TRUE(outcome) << outcome.error().ToString();
    undone = PictureOf(*application, false);
    ExpectItDrives(*application, 2.0);
  }
  const HeldResources held;
  for (const InjectedFault fault : kInjectedFaults) {
    bool has_struck = true;
    for (std::size_t nth = 1; has_struck && !::testing::Test::HasFailure(); nth += 1 + nth / 50) {
      SCOPED_TRACE(NameOf(fault) + " " + std::to_string(nth));
      auto application = make();
      const std::string before = PictureOf(*application, true);
      FaultInjection injection(fault, nth);
      auto outcome = undo(*application);
      injection.End();
      has_struck = injection.has_struck();
      EXPECT_TRUE(outcome || has_struck);
      if (!outcome) {
        EXPECT_EQ(PictureOf(*application, true), before) << outcome.error().ToString();
        if (application->history().NextUndo()) {
          outcome = undo(*application);
          EXPECT_TRUE(outcome) << outcome.error().ToString();
        }
      }
      if (outcome) {
        EXPECT_EQ(PictureOf(*application, false), undone);
        ExpectItDrives(*application, 2.0);
      }
      application.reset();
      held.AwaitAgain();
    }
  }
}

TEST(NetworkUndoFaults, AnAdditionIsUndoneOrNot) { EndureUndo(kAdd); }
TEST(NetworkUndoFaults, ADeletionIsUndoneOrNot) { EndureUndo(kDelete); }
TEST(NetworkUndoFaults, ASwapIsUndoneOrNot) { EndureUndo(kSwap); }
TEST(NetworkUndoFaults, ASwapOfAFusionIsUndoneOrNot) { EndureUndo(kSwapFusion); }
TEST(NetworkUndoFaults, AnInhibitionIsUndoneOrNot) { EndureUndo(kInhibit); }
TEST(NetworkUndoFaults, AGroupThatIsABehaviourIsUndoneOrNot) { EndureUndo(kCrowd); }

TEST(NetworkLoadingFaults, ANetworkIsLoadedAsAWholeOrNotAtAll) {
  const auto read = [](Application& application) {
    (void)application.runtime().robot_stop().Press("a test");
    return PictureOf(application, false);
  };
  std::string expected;
  {
    const auto application = MakeNetwork();  // and what the process does once
    ASSERT_NE(application, nullptr);
    expected = read(*application);
  }
  const HeldResources held;
  for (const InjectedFault fault : kInjectedFaults) {
    bool has_struck = true;
    for (std::size_t nth = 1; has_struck && !HasFailure(); nth += 1 + nth / 50) {
      SCOPED_TRACE(NameOf(fault) + " " + std::to_string(nth));
      std::optional<LoadedApplication> loaded;
      FaultInjection injection(fault, nth);
      try {
        loaded.emplace(LoadNetwork());
      } catch (const std::bad_alloc&) {  // before loading has begun, or while it was being told
      }
      injection.End();
      has_struck = injection.has_struck();
      const bool is_loaded = loaded && *loaded;
      EXPECT_TRUE(is_loaded || has_struck);
      if (is_loaded) {
        EXPECT_EQ(read(**loaded), expected);
        ExpectItDrives(**loaded, 2.0);
      }
      loaded.reset();
      held.AwaitAgain();
    }
  }
}

// What has failed can be replaced, and all drives again.
TEST(NetworkCycleFaults, ABehaviourThatFailsInACycleFailsAlone) {
  for (const InjectedFault fault : kInjectedFaults) {
    bool has_struck = true;
    for (std::size_t nth = 1; has_struck && !HasFailure(); ++nth) {
      SCOPED_TRACE(NameOf(fault) + " " + std::to_string(nth));
      const auto application = MakeNetwork();
      (void)application->runtime().robot_stop().Press("a test");
      (void)application->TakeEvents();
      const std::string before = PictureOf(*application, true);
      FaultInjection injection(fault, nth);
      try {
        (void)application->RunCycles(3);
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      has_struck = injection.has_struck();
      EXPECT_TRUE(application->RunCycles(5));
      EXPECT_EQ(PictureOf(*application, true), before);
      EXPECT_EQ(SpeedOf(*application), 0.0);
      const std::set<std::string> failed = TakeFailed(*application);
      EXPECT_TRUE(failed.empty() || has_struck);
      EXPECT_LE(failed.size(), 1u);
      EXPECT_TRUE(fault == InjectedFault::kAllocation || failed.size() == (has_struck ? 1u : 0u));
      for (const std::string& each : failed) {
        const std::string type = each == kFusion ? "behaviours/fusion" : "wishes/wisher";
        const auto outcome = application->Apply({ReplaceModule{each, type}});
        EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
      }
      ExpectItDrives(*application, 2.0);
    }
  }
}

TEST(NetworkCycleFaults, ABehaviourThatFailsAtOnceGivesItsPlaceBack) {
  const auto application = MakeNetwork();
  (void)application->runtime().robot_stop().Press("a test");
  const std::string before = PictureOf(*application, true);
  const auto outcome = application->Apply({ReplaceModule{kAvoid, "wishes/bad"}});
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_NE(PictureOf(*application, true), before);
  WaitUntil("the one before is back", [&] {
    EXPECT_TRUE(application->RunCycles(1));
    EXPECT_EQ(SpeedOf(*application), 0.0);
    return PictureOf(*application, true) == before;
  });
  ExpectItDrives(*application, 2.0);
}

}  // namespace
}  // namespace runnel::test
