#include "core/lockfree/thread_epoch.h"
#include "core/module/kept_state.h"
#include "core/port/port.h"
#include "tests/plugins/genom_modules/component_fixture.h"

namespace runnel::test {
namespace {

using ComponentLifeTest = ComponentTest;

TEST_F(ComponentLifeTest, EndsActivitiesWhenItIsKilled) {
  rig.RunCycles(2);
  const auto wait = Begin("wait", "{turns: 100}");
  rig.RunCycles(3);
  EXPECT_EQ(Call("kill"), "done");
  rig.RunCycles(4);
  EXPECT_EQ(Outcome("wait", *wait), "1099");
  EXPECT_THAT(Call("get"), HasSubstr("interrupted {by: kill}"));
}

TEST_F(ComponentLifeTest, EndsActivitiesWhenItGoes) {
  rig.RunCycles(2);
  const auto wait = Begin("wait", "{turns: 100}");
  rig.RunCycles(3);
  const Port& port = PortAt("wait");
  const TypeInfo* const reply = port.FindAnnotation<Callable>()->reply();
  ASSERT_TRUE(rig.runtime.Delete(rig.module));
  (void)CollectRetired();
  ASSERT_EQ(wait->Poll(rig.now()), CallStatus::kAnswered) << wait->error();
  EXPECT_EQ(ToText(*reply, wait->reply()), "1099");
}

// Its ports and ids have not gone to the other one yet.
TEST_F(ComponentLifeTest, EndsActivitiesBeforeAnotherTakesItsPlaceAndBeginsAfreshIfNoneDoes) {
  rig.RunCycles(2);
  const auto wait = Begin("wait", "{turns: 100}");
  rig.RunCycles(3);
  rig.module.FindAnnotation<BeforeHandOver>()->settle();
  EXPECT_EQ(Outcome("wait", *wait), "1099");
  rig.RunCycles(2);
  const auto again = Begin("wait", "{turns: 2}");
  rig.RunCycles(10);
  EXPECT_THAT(Outcome("wait", *again), testing::Not(testing::AnyOf("pending", HasSubstr("interrupted"))));
}

TEST_F(ComponentLifeTest, AsksForWhatIsSetBeforeItBeginsAfreshTheDefaultToo) {
  rig.Set("set_gain", "7");
  rig.RunCycles(2);
  rig.module.FindAnnotation<BeforeHandOver>()->settle();
  rig.Set("set_gain", "1.5");
  rig.RunCycles(4);
  EXPECT_EQ(Parameter("set_gain"), "1.5");
  EXPECT_THAT(Call("get"), HasSubstr("gain: 1.5"));
}

// It runs in a thread that no hold of cycles keeps.
TEST_F(ComponentLifeTest, WaitsForAnAsynchronousCodelBeforeAnotherTakesItsPlace) {
  static const SteadyClock clock;  // outlives the rig; on others a cycle waits for it anyway
  rig.runtime.set_clock(clock);
  rig.RunCycles(2);
  const auto grind = Begin("grind", "{times: 1, microseconds: 200000}");
  rig.RunCycles(2);
  ASSERT_EQ(Outcome("grind", *grind), "pending");
  rig.module.FindAnnotation<BeforeHandOver>()->settle();
  EXPECT_EQ(Outcome("grind", *grind), "1");
}

// Also if another was to take its place, and has not.
TEST_F(ComponentLifeTest, StaysKilled) {
  rig.RunCycles(2);
  EXPECT_EQ(Call("kill"), "done");
  rig.RunCycles(4);
  rig.module.FindAnnotation<BeforeHandOver>()->settle();
  rig.RunCycles(4);
  EXPECT_THAT(Call("get"), HasSubstr("interrupted {by: kill}"));
}

TEST_F(ComponentLifeTest, InterruptsActivitiesThatCannotStopWhenItGoes) {
  rig.RunCycles(2);
  const auto tick = Begin("tick", "{turns: 100}");
  rig.RunCycles(3);
  ASSERT_TRUE(rig.runtime.Delete(rig.module));
  (void)CollectRetired();
  EXPECT_EQ(tick->Poll(rig.now()), CallStatus::kFailed);
  EXPECT_EQ(tick->error(), "interrupted {by: kill}");
}

TEST_F(ComponentLifeTest, IsStoppedByAPermanentActivityThatFails) {
  Port& seen = PortAt("seen");
  auto source = seen.MakeOutput(rig.runtime.root(), "source", {});
  ASSERT_TRUE(Port::Connect(*source, seen));
  ASSERT_TRUE(
      source->PublishFilled([&](void* value) { return SetFromText(seen.type(), "{at: {x: 99}}", value); }, rig.now()));
  const auto fault = rig.RunUntilFault(3);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->message, HasSubstr("probe::wrong {which: left, limit: 99}"));
}

TEST(ComponentPeriodTest, IsHeldAgainstThatOfTheThread) {
  ModuleRig<FrameworkElement> rig{"probe/probe", 50ms};
  const auto fault = rig.RunUntilFault(1);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->message, HasSubstr("task 'drive' has a period of 20ms and a delay of 10ms"));
}

}  // namespace
}  // namespace runnel::test
