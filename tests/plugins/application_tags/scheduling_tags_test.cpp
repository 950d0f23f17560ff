// What application files say of threads, clocks and faults.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/log/log_level.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/reading/test_application.h"
#include "tests/plugins/supervision/notices.h"

namespace runnel::testing {
namespace {

using Activation = ThreadOptions::Activation;

class Counter final : public Module {
 public:
  using Module::Module;
  Output<std::int64_t> count{this, "count"};

 private:
  void Update() override { count.Publish(++updates_); }
  std::int64_t updates_ = 0;
};

class Bomb final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override { throw std::runtime_error("boom"); }
};

struct SchedulingTags : ::testing::Test, Workshop {
  SchedulingTags() {
    Add<Counter>("test/counter");
    Add<Bomb>("test/bomb");
  }
};

/// Does what the application's rules say.
struct Supervision {
  Supervision(Workshop& shop, const FrameworkElement& application)
      : scheduler(shop.runtime, SchedulerOptionsOf(application)),
        editor(shop.runtime, shop.plugins.modules(), &scheduler),
        supervisor(shop.runtime, scheduler, [this](const ChangeSet& changes) -> Result<ChangeSet> {
          const ChangeOutcome outcome = editor.Apply(changes);
          return outcome ? Result(ChangeSet()) : outcome.diagnostics.errors().front();
        }) {
    EXPECT_TRUE(AddRules(application, scheduler, supervisor));
  }
  Scheduler scheduler;
  StructureEditor editor;
  Supervisor supervisor;
};

TEST_F(SchedulingTags, MakeThreadsBelowTheApplication) {
  ASSERT_TRUE(Build(R"(<application name="demo">
    <thread name="fast" period="5ms" priority="3" on_overrun="catch_up"/>
    <thread name="free" activation="free_running"/>
    <thread name="events" activation="trigger"/>
  </application>)"))
      << diagnostics.ToString();
  const ThreadOptions& fast = Get<ThreadContainer>("/demo/threads/fast").options();
  EXPECT_EQ(fast.activation, Activation::kPeriod);
  EXPECT_EQ(fast.period, std::chrono::milliseconds(5));
  EXPECT_EQ(fast.priority, 3);
  EXPECT_EQ(fast.on_overrun, ThreadOptions::OnOverrun::kCatchUp);
  const ThreadOptions& free = Get<ThreadContainer>("/demo/threads/free").options();
  EXPECT_EQ(free.activation, Activation::kFreeRunning);
  EXPECT_EQ(free.on_overrun, ThreadOptions::OnOverrun::kSkip);
  EXPECT_EQ(Get<ThreadContainer>("/demo/threads/events").options().activation, Activation::kTrigger);
}

TEST_F(SchedulingTags, AssignGroupsAndModulesToThreads) {
  FrameworkElement* const application = Build(R"(<application name="demo" thread="slow">
    <group name="robot" thread="fast">
      <module name="a" type="test/counter"/>
      <module name="b" type="test/counter" thread="slow"/>
    </group>
    <module name="c" type="test/counter"/>
    <thread name="fast" period="10ms"/>
    <thread name="slow" period="50ms"/>
    <clock type="simulated" speed="0"/>
  </application>)");
  ASSERT_TRUE(application) << diagnostics.ToString();
  Scheduler scheduler(runtime, SchedulerOptionsOf(*application));
  EXPECT_TRUE(scheduler.RunUntil(Time(std::chrono::milliseconds(100))));
  EXPECT_EQ(Get<Counter>("/demo/robot/a").count.publications(), 10u);
  EXPECT_EQ(Get<Counter>("/demo/robot/b").count.publications(), 2u);
  EXPECT_EQ(Get<Counter>("/demo/c").count.publications(), 2u);
}

TEST_F(SchedulingTags, NameTheNearestThread) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <thread name="control" period="50ms"/>
  <group name="g" thread="contrl"/>
</application>)"),
            "app.xml:3:27: error: /demo/g: there is no thread 'contrl'; did you mean 'control'?\n");
  EXPECT_EQ(Errors(R"(<application name="demo"><group name="g" thread="x"/></application>)"),
            "app.xml:1:50: error: /demo/g: there is no thread 'x'; add <thread name=\"x\" "
            "period=\"50ms\"/> to the application\n");
}

TEST_F(SchedulingTags, TellWhatIsWrongWithThreads) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <thread name="a"/>
  <thread name="b" period="50"/>
  <thread name="c" period="50ms" priority="100"/>
  <thread name="d" period="50ms" activation="trigger"/>
  <thread name="c" period="5ms"/>
  <thread name="e" period="0ms"/>
</application>)"),
            "app.xml:2:3: error: /demo/threads/a: <thread> has no 'period'; add period=\"50ms\", or "
            "activation=\"trigger\" or activation=\"free_running\"\n"
            "app.xml:3:28: error: /demo/b: '50' is no duration; write a number and a unit: ns, us, "
            "ms, s or min, as in 20ms\n"
            "app.xml:4:44: error: /demo/threads/c: priority 100 is out of bounds; 0 is ordinary "
            "scheduling, 1 .. 99 is SCHED_FIFO\n"
            "app.xml:5:20: error: /demo/threads/d: a thread that waits for data has no period; leave out "
            "either period or activation\n"
            "app.xml:6:17: error: /demo/threads/c: there is already an element called 'c' in "
            "/demo/threads; the first is in line 4\n"
            "app.xml:7:28: error: /demo/e: '0ms' is not longer than nothing\n");
  EXPECT_TRUE(runtime.root().children().empty());
}

TEST_F(SchedulingTags, ChooseTheClock) {
  const auto options = [&](const char* clock) {
    FrameworkElement* const application = Build(std::string("<application name='demo'>") + clock + "</application>");
    EXPECT_TRUE(application) << diagnostics.ToString();
    const SchedulerOptions chosen = SchedulerOptionsOf(*application);
    EXPECT_TRUE(runtime.Delete(*application));
    return chosen;
  };
  EXPECT_EQ(options("").clock, SchedulerOptions::ClockKind::kReal);
  EXPECT_EQ(options("<clock type='real'/>").clock, SchedulerOptions::ClockKind::kReal);
  EXPECT_EQ(options("<clock type='simulated'/>").clock, SchedulerOptions::ClockKind::kSimulated);
  EXPECT_EQ(options("<clock type='simulated'/>").speed, 1.0);
  EXPECT_EQ(options("<clock type='simulated' speed='2.5'/>").speed, 2.5);
  EXPECT_FALSE(options("<clock type='simulated'/>").is_paused);
  EXPECT_FALSE(options("<clock type='simulated' paused='false'/>").is_paused);
  EXPECT_TRUE(options("<clock type='simulated' paused='true'/>").is_paused);
}

TEST_F(SchedulingTags, TellWhatIsWrongWithClocks) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <clock type="simulated" speed="-1"/>
  <clock type="real"/>
</application>)"),
            "app.xml:2:34: error: /demo: time cannot run backwards; 1 is real time, 0 as fast as "
            "it can\n"
            "app.xml:3:3: error: /demo: the clock is chosen twice; the first is in line 2\n");
  EXPECT_EQ(Errors(R"(<application name="demo">
  <clock type="simulated" speed="1e-300"/>
</application>)"),
            "app.xml:2:34: error: /demo: speed 1e-300 is out of bounds; allowed is 0 (as fast as it "
            "can), or 1e-6 .. 1e6\n");
  EXPECT_EQ(Errors(R"(<application name="demo">
  <clock type="real" speed="2"/>
</application>)"),
            "app.xml:2:22: error: /demo: the speed of real time cannot be chosen; leave out speed, "
            "or write type=\"simulated\"\n");
  EXPECT_EQ(Errors(R"(<application name="demo">
  <clock type="real" paused="true"/>
</application>)"),
            "app.xml:2:22: error: /demo: real time cannot be paused; leave out paused, or write "
            "type=\"simulated\"\n");
}

TEST_F(SchedulingTags, SayWhatHappensOnFaults) {
  FrameworkElement* const application = Build(R"(<application name="demo">
    <clock type="simulated" speed="0"/>
    <thread name="control" period="10ms"/>
    <group name="robot">
      <module name="bomb" type="test/bomb"/>
      <on_fault of="bomb" set="../source/gain" value="7"/>
    </group>
    <module name="source" type="test/source"/>
    <on_fault of="robot" action="quit"/>
  </application>)");
  ASSERT_TRUE(application) << diagnostics.ToString();
  const auto* const rules = application->FindAnnotation<RunRules>();
  ASSERT_TRUE(rules);
  ASSERT_EQ(rules->rules.size(), 2u);
  EXPECT_EQ(rules->rules[0].of, "/demo/robot/bomb");
  EXPECT_EQ(rules->rules[1].of, "/demo/robot");

  Supervision supervision(*this, *application);
  Scheduler& scheduler = supervision.scheduler;
  EXPECT_FALSE(scheduler.RunUntil(Time(std::chrono::seconds(1))));
  EXPECT_TRUE(scheduler.stop_requested());
  EXPECT_EQ(Get<Source>("/demo/source").gain.Get(), 7.0);
}

TEST_F(SchedulingTags, AFaultRuleWhoseParameterIsGoneIsReported) {
  FrameworkElement* const application = Build(R"(<application name="demo">
    <clock type="simulated" speed="0"/>
    <thread name="control" period="10ms"/>
    <module name="bomb" type="test/bomb"/>
    <module name="source" type="test/source"/>
    <on_fault of="bomb" set="source/gain" value="7"/>
  </application>)");
  ASSERT_TRUE(application) << diagnostics.ToString();
  Supervision supervision(*this, *application);
  ASSERT_TRUE(runtime.Delete(Get<Source>("/demo/source")));
  supervision.scheduler.RunUntil(Time(std::chrono::seconds(1)));
  const auto notices = test::NoticesOf(supervision.supervisor);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].path, "/demo/bomb");
  EXPECT_TRUE(notices[0].is_failure);
  EXPECT_NE(notices[0].message.find("no 'source' in /demo"), std::string::npos) << notices[0].message;
}

TEST_F(SchedulingTags, TellWhatIsWrongWithFaultRules) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <module name="source" type="test/source"/>
  <on_fault of="sorce" action="quit"/>
  <on_fault of="source"/>
  <on_fault of="source" set="source/gain"/>
  <on_fault of="source" set="source/gain" value="70"/>
  <on_fault of="source" set="source/gian" value="7"/>
  <on_fault of="source" set="source/text" value="7"/>
  <on_fault of="source" set="source/output/value" value="7"/>
</application>)"),
            "app.xml:3:17: error: /demo: there is no 'sorce' in /demo; did you mean 'source'?\n"
            "app.xml:4:3: error: /demo: <on_fault> must say one thing that is to be done; write "
            "either action=\"quit\" or set=\"…\" value=\"…\"\n"
            "app.xml:5:3: error: /demo: <on_fault> does not say to which value; add value=\"…\"\n"
            "app.xml:6:50: error: /demo/source/parameter/gain: 70 m is out of bounds; allowed is 0 "
            ".. 10 m\n"
            "app.xml:7:30: error: /demo: there is no 'gian' in /demo/source; did you mean 'gain'?\n"
            "app.xml:8:30: error: /demo/source/parameter/text: the parameter is static: it cannot "
            "be set while its module runs\n"
            "app.xml:9:30: error: /demo: /demo/source/output/value cannot be set\n");
}

TEST_F(SchedulingTags, TellOneMistakeOfAThreadOnce) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <thread name="control" activation="triggered"/>
  <group name="g" thread="control"/>
</application>)"),
            "app.xml:2:38: error: /demo/control: 'triggered' is not possible for activation; did "
            "you mean 'trigger'?\n");
  EXPECT_EQ(Errors(R"(<application name="demo">
  <thread nmae="control" perod="5ms"/>
  <group name="g" thread="control"/>
</application>)"),
            "app.xml:2:11: error: /demo: <thread> knows no 'nmae'; did you mean 'name'?\n");
  EXPECT_EQ(Errors(R"(<application name="demo">
  <thread period="5ms"/>
  <group name="g" thread="control"/>
</application>)"),
            "app.xml:2:3: error: /demo: <thread> has no 'name'; add name=\"…\"\n");
}

TEST_F(SchedulingTags, InAWrongPlaceAreNotMissingInTheRightOne) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <group name="g" thread="control">
    <thread name="control" period="5ms"/>
  </group>
</application>)"),
            "app.xml:3:5: error: /demo/g: no <thread> may stand in <group>; it stands in "
            "<application>: a thread that runs modules, in the order of the data flow\n");
}

TEST_F(SchedulingTags, KnowAMisspeltThreadOfAModule) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <thread name="control" period="5ms"/>
  <module name="a" type="test/counter" thraed="contrl"/>
</application>)"),
            "app.xml:3:40: error: /demo/a: <module> knows no 'thraed'; did you mean 'thread'?\n");
}

TEST_F(SchedulingTags, SayFromWhichLevelOnModulesAreLogged) {
  ASSERT_TRUE(Build(R"(<application name="demo">
    <log level="error"/>
    <group name="g"> <log level="debug"/> <log level="off" of="a"/> <module name="a" type="test/counter"/> </group>
  </application>)"))
      << diagnostics.ToString();
  EXPECT_EQ(ReadLogLevels(runtime),
            (LogLevels{{"/demo", LogLevel::kError}, {"/demo/g", LogLevel::kDebug}, {"/demo/g/a", LogLevel::kOff}}));
}

TEST_F(SchedulingTags, KnowAMisspeltLevelAndWhoIsNotThere) {
  EXPECT_EQ(Errors(R"(<application name="demo">
  <log level="debgu"/>
  <log level="debug" of="b"/>
  <module name="a" type="test/counter"/>
</application>)"),
            "app.xml:2:15: error: /demo: 'debgu' is not possible for level; did you mean 'debug'?\n"
            "app.xml:3:26: error: /demo: there is no 'b' in /demo; did you mean 'a'?\n");
}

}  // namespace
}  // namespace runnel::testing
