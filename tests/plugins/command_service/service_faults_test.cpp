// Wherever memory runs out, an answer says whether it has been done.

#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <semaphore>
#include <string>

#include <gmock/gmock.h>

#include "core/module/module.h"
#include "core/plugin/module_type_name.h"
#include "core/port/input.h"
#include "plugins/command_service/command_service.h"
#include "plugins/command_service/hand_settings.h"
#include "plugins/structure/change_history.h"
#include "plugins/testing/fault_injection.h"

namespace runnel::test {
namespace {

class Idle final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override {}
};

/// An application that nobody runs, with two modules, of which one was made by a change that can be undone.
class World {
 public:
  World() {
    for (const char* type : {"test/idle", "test/other"}) {
      (void)modules.Add({type, "", "test", [](const Placement& placement) {
                           return std::unique_ptr<FrameworkElement>(std::make_unique<Idle>(placement));
                         }});
    }
    (void)runtime.MakeReady(runtime.root());
    (void)editor.Apply({CreateModule{"/first", "test/idle"}});
    (void)history.Apply({CreateModule{"/second", "test/idle"}});
  }

  /// The type of a module; "": it is not there.
  std::string TypeAt(const std::string& path) {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto found = runtime.root().Find(path);
    return found ? FindModuleType(**found) : "";
  }
  /// Waits for all that was asked for before.
  void WaitForWorker() {
    std::binary_semaphore done(0);
    TaskGroup tasks(service.worker());
    const auto task = tasks.Post([] {}, [&] { done.release(); });
    done.acquire();
  }

  bool is_saved = false;
  Runtime runtime;
  ModuleRegistry modules;
  StructureEditor editor{runtime, modules, nullptr};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  ServiceHooks hooks{.save = [this](const std::string& file) -> Result<std::string> {
    std::string done = "saved the application to the file that is called " + file;
    is_saved = true;
    return done;
  }};
  CommandService service{{runtime, modules, editor, log, hooks, &history}};
};

/// Has the worker meet a failing allocation at each point of the request.
void Endure(const CommandRequest& request, const std::function<bool(World&)>& is_done) {
  bool has_struck = true;
  std::size_t nth = 0;
  while (has_struck) {
    SCOPED_TRACE(++nth);
    World world;
    std::optional<FaultInjection> injection;
    std::binary_semaphore done(0);
    TaskGroup tasks(world.service.worker());
    (void)tasks.Post([&] { injection.emplace(InjectedFault::kAllocation, nth); });
    const auto pending = world.service.Begin(request, tasks, [&] {
      has_struck = injection->has_struck();
      injection.reset();
      done.release();
    });
    done.acquire();
    const CommandAnswer answer = pending->Take();
    ASSERT_EQ(static_cast<bool>(answer), is_done(world)) << answer.diagnostics.ToString();
    if (answer) {
      ASSERT_TRUE(answer.diagnostics.ok());
      ASSERT_FALSE(answer.text.empty());
    }
  }
  EXPECT_GT(nth, 1u);
}

ChangeRequest Request(ChangeSet changes) { return {{.changes = std::move(changes), .positions = {}}}; }

TEST(ServiceFaults, AChangeIsToldAsDoneIfItIs) {
  Endure(Request({CreateModule{"/a_module_with_a_long_name", "test/idle"}}),
         [](World& world) { return !world.TypeAt("/a_module_with_a_long_name").empty(); });
}
TEST(ServiceFaults, AReplacementIsToldAsDoneIfItIs) {
  Endure(Request({ReplaceModule{"/first", "test/other"}}),
         [](World& world) { return world.TypeAt("/first") == "test/other"; });
}
TEST(ServiceFaults, AStepBackIsToldAsDoneIfItIs) {
  Endure(UndoRequest{}, [](World& world) { return world.TypeAt("/second").empty(); });
}
TEST(ServiceFaults, ASavedFileIsToldAsSaved) {
  Endure(SaveRequest{"application.xml"}, [](World& world) { return world.is_saved; });
}

TEST(ServiceFaults, WhatCouldNotBeAskedForIsNotDone) {
  auto world = std::make_unique<World>();
  auto tasks = std::make_unique<TaskGroup>(world->service.worker());
  CommandRequest request = Request({CreateModule{"/new", "test/idle"}});
  CommandRequest given = request;
  std::unique_ptr<PendingCommand> pending;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          pending = world->service.Begin(std::move(given), *tasks);
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool) {
        world->WaitForWorker();
        ASSERT_EQ(world->TypeAt("/new").empty(), pending == nullptr);
        given = request;
        if (!pending) return;
        pending.reset();
        tasks.reset();
        world = std::make_unique<World>();
        tasks = std::make_unique<TaskGroup>(world->service.worker());
      });
  EXPECT_GT(points, 2u);
}

class Base final : public Module {
 public:
  using Module::Module;
  Input<double> speed{this, "speed", {.limits = {.default_value = 0.0}}};

 private:
  void Update() override {}
};

/// A base that is driven by hand with a deadline, by a clock that only a test moves.
struct Driven {
  Driven() { (void)runtime.MakeReady(runtime.root()); }
  void Drive() {
    const std::chrono::milliseconds deadline(250);
    (void)by_hand.Publish({"/base/input/speed", "0.3", {}, Duration(deadline), "hold"});
  }
  void LetTheDeadlinePass() { machine.Advance(std::chrono::seconds(1)); }

  Runtime runtime;
  Base& base = runtime.Create<Base>(runtime.root(), "base");
  ApplicationLog log{runtime.clock()};
  CommandWorker worker;
  ManualClock machine;
  HandSettings by_hand{runtime, worker, log, &machine};
};

TEST(DrivingFaults, WhatIsPublishedHasItsDeadline) {
  auto robot = std::make_unique<Driven>();
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          robot->Drive();
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool has_struck) {
        ASSERT_TRUE(has_struck || robot->base.speed.Get() == 0.3);
        robot->LetTheDeadlinePass();
        robot->by_hand.LookAtDeadlines();
        ASSERT_EQ(robot->base.speed.Get(), 0.0);
        robot = std::make_unique<Driven>();
      });
  EXPECT_GT(points, 2u);
}

TEST(DrivingFaults, WhatCannotBePublishedAgainIsNotPublishedAtAll) {
  auto robot = std::make_unique<Driven>();
  bool is_published = false;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        is_published = false;
        try {
          is_published = robot->by_hand.Publish({"/base/input/speed", "0.3", 10.0}).has_value();
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool has_struck) {
        ASSERT_TRUE(has_struck || is_published);
        ASSERT_EQ(robot->base.speed.is_set_by_hand(), is_published);
        ASSERT_EQ(robot->base.speed.Get(), is_published ? 0.3 : 0.0);
        ASSERT_TRUE(robot->by_hand.Publish({"/base/input/speed", "0.2", 10.0}));
        ASSERT_EQ(robot->base.speed.Get(), 0.2);
        robot = std::make_unique<Driven>();
      });
  EXPECT_GT(points, 2u);
}

TEST(DrivingFaults, WhoWatchesTheDeadlinesGoesOn) {
  auto robot = std::make_unique<Driven>();
  const auto begin = [&] {
    robot = std::make_unique<Driven>();
    robot->Drive();
    robot->LetTheDeadlinePass();
  };
  begin();
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { ASSERT_NO_THROW(robot->by_hand.LookAtDeadlines()); },
      [&](bool) {
        robot->by_hand.LookAtDeadlines();
        ASSERT_EQ(robot->base.speed.Get(), 0.0);
        begin();
      });
  EXPECT_GT(points, 0u);
}

// For a while there is none at all.
TEST(CommandServiceFaults, TheDeadManPressesWithoutMemory) {
  Runtime runtime;
  ManualClock machine;
  OperatorWatch watch(runtime.robot_stop(), &machine);
  watch.Begin(std::chrono::seconds(2));
  watch.Hear("an operator whose name is too long to be within itself", machine.Now());
  machine.Advance(std::chrono::seconds(3));
  FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
  const auto next = watch.Look();
  injection.End();
  EXPECT_EQ(next, std::nullopt);
  EXPECT_TRUE(runtime.robot_stop().in_force());
  EXPECT_FALSE(runtime.robot_stop().state().by.empty());
}

TEST(CommandServiceFaults, ARequestForAStopPressesBeforeItNeedsMemory) {
  World world;
  TaskGroup tasks(world.service.worker());
  CommandRequest request = RobotStopRequest{true, "a terminal whose name is too long to be within itself"};
  FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
  EXPECT_THROW((void)world.service.Begin(std::move(request), tasks, {}, {}), std::bad_alloc);
  injection.End();
  EXPECT_TRUE(world.runtime.robot_stop().in_force());
}

TEST(CommandServiceFaults, AHoldThatEndsWithoutMemoryHasEndedItsLease) {
  const auto ended = std::make_shared<EndedLeases>();
  auto hold = std::make_unique<HandHold>(ended);
  const std::string lease = "a lease whose name is too long to be within itself";
  (void)hold->Note({.lease = lease, .deadline = std::chrono::seconds(1)});
  FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
  hold.reset();
  injection.End();
  EXPECT_TRUE(ended->Has(lease));
}

}  // namespace
}  // namespace runnel::test
