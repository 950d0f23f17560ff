#pragma once

#include <string>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "plugins/supervision/supervisor.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/wait_until.h"

namespace runnel::testing {

using test::WaitUntil;

/// Nothing runs but the button: what it is fed with is the test's.
class StopButtonTest : public ::testing::Test {
 protected:
  StopButtonTest() { MustSucceed(runtime.MakeReady(runtime.root())); }
  void Press(double value) { panel.out.Publish(value); }
  void WaitForStop(const std::string& by) {
    WaitUntil("the STOP is in force", [&] { return runtime.robot_stop().in_force(); });
    WaitUntil("it is known who has pressed it",
              [&] { return runtime.robot_stop().state().by.find(by) != std::string::npos; });
  }
  /// Values are taken in their order: when something has come of this one, those before have been looked at.
  void WaitUntilTaken() {
    const auto before = runtime.robot_stop().state().changes;
    Press(1);
    WaitUntil("the button has been pressed", [&] { return runtime.robot_stop().state().changes > before; });
  }

  Runtime runtime;
  Group& app = runtime.Create<Group>(runtime.root(), "app");
  Doing& panel = runtime.Create<Doing>(app, "panel");
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  Supervisor supervisor{runtime, scheduler, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); }};
};

}  // namespace runnel::testing
