#pragma once

#include <atomic>
#include <functional>

#include <gmock/gmock.h>

#include "plugins/structure/structure_editor.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/supervision/supervisor.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/plugins/supervision/notices.h"
#include "tests/support/wait_until.h"

namespace runnel::supervised {

using test::WaitUntil;

inline ChangeSet Switch(const Port& input, const Port& from, const Port& to) {
  return {DisconnectPorts{from.path(), input.path()}, ConnectPorts{to.path(), input.path()}};
}

/// Two sensors that say which they are as long as they work, and a reader that is fed by the first.
struct Robot {
  explicit Robot(SchedulerOptions::ClockKind clock) : scheduler(runtime, {.clock = clock}) {
    laser.action = [this](Doing& module) {
      if (laser_throws) throw std::runtime_error("no answer");
      if (laser_works) module.out.Publish(1);
    };
    infrared.action = [](Doing& module) { module.out.Publish(2); };
    reader.action = [this](Doing& module) { seen = module.in.Get(); };
    MustSucceed(Port::Connect(laser.out, reader.in));
    MustSucceed(runtime.MakeReady(runtime.root()));
  }
  SupervisionRule SwitchingRule() {
    return {
        .of = reader.in.path(),
        .after = 30ms,
        .fresh_after = 50ms,
        .reaction = {.changes = Switch(reader.in, laser.out, infrared.out), .description = "switched to infrared"},
        .otherwise = {.changes = Switch(reader.in, infrared.out, laser.out), .description = "switched to the laser"}};
  }
  std::vector<std::string> Messages() {
    std::vector<std::string> messages;
    for (const Notice& notice : test::NoticesOf(supervisor)) messages.push_back(notice.message);
    return messages;
  }

  Runtime runtime;
  ModuleRegistry modules;
  ThreadContainer& thread = CreateThread(runtime, "main", {.period = 10ms});
  Doing& laser = runtime.Create<Doing>(runtime.root(), "laser");
  Doing& infrared = runtime.Create<Doing>(runtime.root(), "infrared");
  Doing& reader = runtime.Create<Doing>(runtime.root(), "reader");
  std::atomic<bool> laser_works{true};
  std::atomic<bool> laser_throws{false};
  std::atomic<double> seen{0};
  std::function<void()> before_changes = [] {};
  Scheduler scheduler;
  StructureEditor editor{runtime, modules, &scheduler};
  Supervisor supervisor{runtime, scheduler, [this](const ChangeSet& changes) -> Result<ChangeSet> {
                          before_changes();
                          const ChangeOutcome outcome = editor.Apply(changes);
                          if (!outcome) return outcome.diagnostics.errors().front();
                          return ChangeSet();
                        }};
};

class Supervised : public ::testing::Test {
 protected:
  // A thread in which nothing runs of itself.
  ThreadContainer& OnlyOnData() {
    return CreateThread(robot.runtime, "idle", {.activation = ThreadOptions::Activation::kTrigger});
  }
  Robot robot{SchedulerOptions::ClockKind::kSimulated};
};

/// Something moves by what the reader reads from the laser.
class Driven : public Supervised {
 protected:
  Driven() {
    MustSucceed(
        robot.reader.in.SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {}, DrivingKind::kEffort));
    robot.scheduler.RunUntil(At(100));
    EXPECT_EQ(robot.seen, 1);
  }
  void RunOn() { robot.scheduler.RunUntil(robot.runtime.clock().Now() + 200ms); }
};

}  // namespace runnel::supervised
