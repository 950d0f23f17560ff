// Tasks that threads of the application run beside the component's module.

#include "plugins/genom_modules/component_state.h"
#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/genom_modules/component_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using Activation = ThreadOptions::Activation;
constexpr std::chrono::seconds kPatience{100};

class TaskModuleTest : public ComponentTest {
 protected:
  /// The module in a thread of 50 ms, its periodic task in one of 10 ms.
  void Assign(Duration of_module = 50ms) {
    AssignThread(rig.module, CreateThread(rig.runtime, "slow", {.period = of_module}));
    (void)CreateThread(rig.runtime, "fast", {.period = 10ms, .priority = 0});
    rig.Set("thread_of_drive", "fast");
  }
  std::string Refusal() {
    const auto prepared = rig.Prepare();
    return prepared ? "" : prepared.error().path + ": " + prepared.error().message + "; " + prepared.error().hint;
  }
  std::unique_ptr<AnyCall> Ask(Scheduler& scheduler, const std::string& service, const std::string& arguments = "") {
    Callable& callable = ServiceAt(service);
    auto call = callable.NewCall();
    if (!arguments.empty()) {
      EXPECT_TRUE(SetFromText(*callable.arguments(), arguments, call->arguments()));
    }
    EXPECT_EQ(call->Begin(Now(scheduler), kPatience), CallStatus::kPending);
    return call;
  }
  Time Now(Scheduler& scheduler) {
    return scheduler.options().clock == SchedulerOptions::ClockKind::kSimulated ? scheduler.simulated_clock().Now()
                                                                                : SteadyClock().Now();
  }
};

TEST_F(TaskModuleTest, HasTheTicksOfItsOwnThread) {
  Assign();
  Scheduler scheduler(rig.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  ASSERT_EQ(Refusal(), "") << "the module's period divides not that of the task, and need not";
  auto source = PortAt("seen").MakeOutput(rig.runtime.root(), "source", {});
  ASSERT_TRUE(Port::Connect(*source, PortAt("seen")));
  Port& echo = PortAt("echo");
  std::vector<std::int64_t> ticks;
  for (Time end{}; end < Time(200ms); end += 10ms) {
    ASSERT_TRUE(source->PublishFilled(
        [&](void* value) {
          return SetFromText(echo.type(), "{at: {x: " + std::to_string(ToSeconds(end)) + "}}", value);
        },
        end));
    (void)scheduler.RunUntil(end + 10ms);
    Time published{};
    echo.VisitLatest([&](const void*, ValueTimes times) { published = times.timestamp; });
    if (published == end && end > Time()) ticks.push_back(end.time_since_epoch() / 1ms);
  }
  // The start is at 0, the first tick after the delay of 10 ms, then every 20 ms.
  EXPECT_THAT(ticks, testing::ElementsAre(10, 30, 50, 70, 90, 110, 130, 150, 170, 190));
  const auto wait = Ask(scheduler, "wait", "{turns: 3}");
  (void)scheduler.RunUntil(Time(500ms));
  EXPECT_EQ(wait->Poll(Now(scheduler)), CallStatus::kAnswered) << wait->error();
  EXPECT_TRUE(scheduler.TakeFaults().empty());
}

TEST_F(TaskModuleTest, SaysWhatIsWrongWithItsThread) {
  rig.Set("thread_of_drive", "fats");
  (void)CreateThread(rig.runtime, "fast", {.period = 15ms});
  EXPECT_THAT(Refusal(), testing::AllOf(HasSubstr("there is no thread 'fats'"), HasSubstr("did you mean 'fast'?")));
}
TEST_F(TaskModuleTest, SaysThatItMissesTicks) {
  (void)CreateThread(rig.runtime, "fast", {.period = 15ms});
  rig.Set("thread_of_drive", "fast");
  EXPECT_THAT(Refusal(),
              HasSubstr("task 'drive' has a period of 20ms and a delay of 10ms, and its thread a period of 15ms"));
}
TEST_F(TaskModuleTest, SaysThatItHasNoTicks) {
  (void)CreateThread(rig.runtime, "data", {.activation = Activation::kTrigger});
  rig.Set("thread_of_drive", "data");
  EXPECT_THAT(Refusal(), HasSubstr("has a period, and thread 'data' waits for data"));
}

TEST_F(TaskModuleTest, FailsAsItsComponent) {
  Assign();
  Scheduler scheduler(rig.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  ASSERT_EQ(Refusal(), "");
  Port& seen = PortAt("seen");
  auto source = seen.MakeOutput(rig.runtime.root(), "source", {});
  ASSERT_TRUE(Port::Connect(*source, seen));
  ASSERT_TRUE(
      source->PublishFilled([&](void* value) { return SetFromText(seen.type(), "{at: {x: 99}}", value); }, Time()));
  (void)scheduler.RunUntil(Time(200ms));
  const auto faults = scheduler.TakeFaults();
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].path, rig.module.path());
  EXPECT_THAT(faults[0].message, HasSubstr("probe::wrong {which: left, limit: 99}"));
}

// Attributes are set by the module's thread while the task's codels use what they set; an aperiodic task in a thread that
// waits is woken by what has happened, and wakes that of the module.
TEST_F(TaskModuleTest, WorksInRealThreads) {
  AssignThread(rig.module, CreateThread(rig.runtime, "main", {.activation = Activation::kTrigger}));
  (void)CreateThread(rig.runtime, "fast", {.activation = Activation::kFreeRunning});
  (void)CreateThread(rig.runtime, "data", {.activation = Activation::kTrigger});
  rig.Set("thread_of_drive", "fast");
  rig.Set("thread_of_link", "data");
  static const SteadyClock clock;  // outlives the rig
  rig.runtime.set_clock(clock);
  Scheduler scheduler(rig.runtime);
  ASSERT_EQ(Refusal(), "");
  auto& state = rig.Follow(rig.output<genom_modules::ComponentState>("genom_state"));
  ASSERT_TRUE(scheduler.Start());
  const auto answer = [&](const std::string& service, const std::string& arguments) {
    const auto call = Ask(scheduler, service, arguments);
    WaitUntil(
        "it is answered", [&] { return call->Poll(Time()) != CallStatus::kPending; }, kPatience);
    return Outcome(service, *call);
  };
  EXPECT_EQ(answer("slow", ""), "true");
  for (int i = 0; i < 50; ++i) EXPECT_EQ(answer("set_gain", "{gain: " + std::to_string(i % 10) + "}"), "done");
  EXPECT_THAT(answer("get", ""), HasSubstr("gain: 9"));
  const auto& parameter = dynamic_cast<const Configurable&>(*rig.module.Find("parameter/set_gain").value());
  const auto is_settled = [&] { return parameter.Outcome().has_value(); };
  for (int i = 0; i < 50; ++i) rig.Set("set_gain", std::to_string(i % 9));
  WaitUntil("it is set", is_settled, kPatience);
  EXPECT_TRUE(*parameter.Outcome());
  rig.Set("set_gain", "12");
  WaitUntil("it is refused", is_settled, kPatience);
  EXPECT_FALSE(*parameter.Outcome());
  EXPECT_THAT(answer("get", ""), HasSubstr("gain: 4"));
  EXPECT_EQ(answer("wait", "{turns: 2}"), "2");
  scheduler.Stop();
  EXPECT_GT(state.Read()->tasks.at(0).longest, 0) << "what codels take is measured for those who look";
  EXPECT_TRUE(scheduler.TakeFaults().empty());
}

// The next one is given to its thread at once, by the cycle that it has set off, or that was looking for its end.
class AsynchronousCodelTest : public TaskModuleTest, public testing::WithParamInterface<Activation> {};

TEST_P(AsynchronousCodelTest, ThatGoesOnWithItselfIsNeverLost) {
  AssignThread(rig.module, CreateThread(rig.runtime, "its", {.activation = GetParam()}));
  (void)CreateThread(rig.runtime, "fast", {.period = 10ms});
  rig.Set("thread_of_drive", "fast");
  static const SteadyClock clock;  // outlives the rig
  rig.runtime.set_clock(clock);
  Scheduler scheduler(rig.runtime);
  ASSERT_EQ(Refusal(), "");
  ASSERT_TRUE(scheduler.Start());
  for (const char* microseconds : {"0", "100"}) {
    const auto call = Ask(scheduler, "grind", std::string("{times: 1000, microseconds: ") + microseconds + "}");
    WaitUntil(
        "it is answered", [&] { return call->Poll(Time()) != CallStatus::kPending; }, kPatience);
    EXPECT_EQ(Outcome("grind", *call), "1000");
  }
  scheduler.Stop();
  EXPECT_TRUE(scheduler.TakeFaults().empty());
}
INSTANTIATE_TEST_SUITE_P(InAThread, AsynchronousCodelTest,
                         testing::Values(Activation::kTrigger, Activation::kFreeRunning));

}  // namespace
}  // namespace runnel::test
