// What letting go of a stop button is, and what only looks like it.

#include <atomic>
#include <limits>
#include <memory>

#include "core/port/driving_ports.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/supervision/stop_button_fixture.h"

namespace runnel::testing {
namespace {

Port::Fill Filling(double wanted) {
  return [wanted](void* value) -> Result<void> { return *static_cast<double*>(value) = wanted, Result<void>(); };
}

class LettingGo : public StopButtonTest {
 protected:
  LettingGo() { MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true})); }
  /// Long enough for it to be looked at: nobody is told that it does nothing.
  void Wait() {
    std::this_thread::sleep_for(200ms);
    (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  }
  void ExpectHeld() {
    EXPECT_TRUE(runtime.robot_stop().in_force()) << "released by " << runtime.robot_stop().state().by;
  }
};

class ValueByHand : public LettingGo, public ::testing::WithParamInterface<Port::Setter> {};
TEST_P(ValueByHand, ReleasesNothingWhenItEnds) {
  Press(0);
  Wait();
  ASSERT_FALSE(runtime.robot_stop().in_force());
  MustSucceed(panel.out.PublishByHand(Filling(1), GetParam()));
  WaitForStop("the button");
  Wait();
  panel.out.Release(GetParam());
  for (int i = 0; i < 5; ++i) {
    Press(0);
    Wait();
  }
  ExpectHeld();
}
TEST_P(ValueByHand, ReleasesNothingInAMomentEither) {
  Press(0);
  Wait();
  {
    const std::lock_guard lock(runtime.structure_mutex());  // so that it is looked at in the end only
    MustSucceed(panel.out.PublishByHand(Filling(1), GetParam()));
    WaitForStop("the button");
    (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
    MustSucceed(panel.out.PublishByHand(Filling(0), GetParam()));
    panel.out.Release(GetParam());
  }
  Wait();
  ExpectHeld();
}
INSTANTIATE_TEST_SUITE_P(Setters, ValueByHand, ::testing::Values(Port::Setter::kPerson, Port::Setter::kRule));

// Nobody has heard what was let go meanwhile.
TEST_F(LettingGo, CountsNotAfterItsModuleWasPaused) {
  Press(1);
  WaitForStop("the button");
  MustSucceed(supervisor.SetPaused("/app/panel", true));
  Wait();
  MustSucceed(supervisor.SetPaused("/app/panel", false));
  Wait();
  Press(0);
  Wait();
  ExpectHeld();
  Press(1);
  Wait();
  Press(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
}

// What does not fit into the queue may have been a press.
TEST_F(LettingGo, APressIsNotLostInABurst) {
  Wait();
  {
    const std::lock_guard lock(runtime.structure_mutex());
    for (int i = 0; i < 500; ++i) Press(0);
    Press(1);
    for (int i = 0; i < 5; ++i) Press(0);
  }
  WaitForStop("the button");
}

/// Its values come from elsewhere, as those of a topic in a network do.
class ElsewherePressed : public StopButtonTest {
 protected:
  ElsewherePressed() {
    panel.out.Annotate(std::make_unique<WritersElsewhere>(writers));
    MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
    WaitForStop("nobody writes to /app/panel/output/out");
    *writers = 1;
    std::this_thread::sleep_for(200ms);  // until it is known
    EXPECT_TRUE(runtime.robot_stop().Release("the test"));
  }
  const std::shared_ptr<std::atomic<std::size_t>> writers = std::make_shared<std::atomic<std::size_t>>(0);
};

TEST_F(ElsewherePressed, PressesWhenItsWriterGoesAndIsNotLetGoByTheNextOne) {
  Press(1);
  WaitForStop("the button /app/panel/output/out");
  const auto requests = runtime.robot_stop().requests();
  *writers = 0;
  WaitUntil("it is pressed once more", [&] { return runtime.robot_stop().requests() > requests; });
  *writers = 1;
  std::this_thread::sleep_for(200ms);
  (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  Press(0);  // as what has been started again begins with
  std::this_thread::sleep_for(200ms);
  EXPECT_TRUE(runtime.robot_stop().in_force());
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  *writers = 0;
  WaitForStop("nobody writes to /app/panel/output/out");
}

TEST_F(ElsewherePressed, ReleasesNothingWhileSeveralWrite) {
  *writers = 2;
  std::this_thread::sleep_for(200ms);
  Press(1);
  WaitForStop("the button /app/panel/output/out");
  (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  Press(0);
  std::this_thread::sleep_for(200ms);
  EXPECT_TRUE(runtime.robot_stop().in_force());
  *writers = 1;  // one that was started again before it was known that it had gone
  std::this_thread::sleep_for(200ms);
  Press(1);
  (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  Press(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
}

TEST(SwappedButton, ReleasesNothingByWhatItBeginsWith) {
  Runtime runtime;
  ModuleRegistry modules;
  MustSucceed(modules.Add({"test/doing", "", "test", [](const Placement& at) { return std::make_unique<Doing>(at); }}));
  (void)runtime.Create<Group>(runtime.root(), "app");
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  StructureEditor editor{runtime, modules, &scheduler};
  const auto apply = [&](const ChangeSet& changes) {
    const ChangeOutcome outcome = editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  };
  apply({CreateModule{"/app/panel", "test/doing"}});
  Supervisor supervisor{runtime, scheduler, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); }};
  const auto panel = [&]() -> Doing& { return dynamic_cast<Doing&>(**runtime.root().Find("/app/panel")); };
  MustSucceed(supervisor.Add(StopButtonRule{panel().out.path(), true}));
  panel().out.Publish(1);
  WaitUntil("the STOP is in force", [&] { return runtime.robot_stop().in_force(); });
  (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  apply({ReplaceModule{"/app/panel", "test/doing"}});
  std::this_thread::sleep_for(200ms);
  (void)scheduler.RunUntil(runtime.clock().Now() + 1s);
  panel().out.Publish(0);
  std::this_thread::sleep_for(200ms);
  EXPECT_TRUE(runtime.robot_stop().in_force());
  panel().out.Publish(1);
  panel().out.Publish(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
}

}  // namespace
}  // namespace runnel::testing
