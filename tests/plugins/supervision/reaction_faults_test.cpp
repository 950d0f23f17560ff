// What rules do while memory is short: nothing keeps up the end of the run, or another rule, and nothing is done twice.

#include <thread>
#include <tuple>

#include "plugins/parameters/parameter.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/structure/structure_request.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/supervision/supervised_robot.h"

namespace runnel::supervised {
namespace {

using test::FaultInjection;
using test::InjectedFault;
using ::testing::SizeIs;
using When = SupervisionRule::When;

class ReactionFaults : public ::testing::Test {
 protected:
  ReactionFaults() {
    robot.infrared.action = [this](Doing& module) {
      if (infrared_throws) throw std::runtime_error("no echo");
      module.out.Publish(2);
    };
  }
  ~ReactionFaults() override { robot.scheduler.Stop(); }
  void EndsTheRun() {
    WaitUntil("the run is to end", [&] { return robot.scheduler.stop_requested(); });
  }

  // Before the robot, whose threads use them until it is stopped.
  std::atomic<bool> infrared_throws{false}, is_stuck{false}, goes_on{false};
  std::atomic<int> tries{0};
  Robot robot{SchedulerOptions::ClockKind::kReal};
};

TEST_F(ReactionFaults, TheRunEndsThoughChangesFindNoMemory) {
  robot.before_changes = [] { throw std::bad_alloc(); };
  MustSucceed(robot.supervisor.Add(
      {.when = When::kFault,
       .of = robot.laser.path(),
       .reaction = {.changes = Switch(robot.reader.in, robot.laser.out, robot.infrared.out), .ends_run = true}}));
  MustSucceed(robot.scheduler.Start());
  robot.laser_throws = true;
  EndsTheRun();
}

TEST_F(ReactionFaults, TheRunEndsThoughAnotherRuleWaitsForMemory) {
  robot.before_changes = [this] { ++tries, throw std::bad_alloc(); };
  MustSucceed(
      robot.supervisor.Add({.when = When::kFault,
                            .of = robot.laser.path(),
                            .reaction = {.changes = Switch(robot.reader.in, robot.laser.out, robot.infrared.out)}}));
  MustSucceed(robot.supervisor.Add(
      {.when = When::kFault, .of = robot.infrared.path(), .reaction = {.released = {"/reader/in"}, .ends_run = true}}));
  MustSucceed(robot.scheduler.Start());
  robot.laser_throws = true;
  WaitUntil("the first rule waits", [&] { return tries > 2; });
  infrared_throws = true;
  EndsTheRun();
}

TEST_F(ReactionFaults, TheRunEndsThoughTheModuleThatIsStuckHasTheLock) {
  robot.infrared.action = [this](Doing&) {
    if (!is_stuck) return;
    const std::lock_guard lock(robot.runtime.structure_mutex());
    while (!goes_on) std::this_thread::yield();
    is_stuck = false;
  };
  MustSucceed(robot.supervisor.Add(
      {.when = When::kStuck, .of = robot.infrared.path(), .after = 50ms, .reaction = {.ends_run = true}}));
  robot.scheduler.SetStuckListener({});  // has its thread look after faults, as an application does
  MustSucceed(robot.scheduler.Start());
  is_stuck = true;
  WaitUntil("the run is to end", [&] { return robot.scheduler.stop_requested(); });
  goes_on = true;
}

struct TwoParameters final : Module {
  using Module::Module;
  Parameter<double> p{this, "p", {.default_value = 0}};
  Parameter<double> q{this, "q", {.default_value = 0}};
  void Update() override {}
};

// Two rules, one after the other: what is saved is what a person has set.
TEST(NotesOfRules, AreMadeOnceThoughMemoryIsShort) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    Robot robot{SchedulerOptions::ClockKind::kSimulated};
    auto& two = robot.runtime.Create<TwoParameters>(robot.runtime.root(), "two");
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    bool is_second = false;
    std::optional<FaultInjection> injection;
    Supervisor supervisor{robot.runtime, robot.scheduler, [&](const ChangeSet& changes) -> Result<ChangeSet> {
                            ChangeSet back;
                            const ChangeOutcome outcome = robot.editor.Apply(changes, {}, {}, &back);
                            if (!outcome) return outcome.diagnostics.errors().front();
                            if (is_second && !injection) injection.emplace(InjectedFault::kAllocation, nth);
                            return back;
                          }};
    const std::string p = two.path() + "/p", q = two.path() + "/q";
    for (const auto& [of, value] : {std::pair(robot.laser.path(), "1"), std::pair(robot.infrared.path(), "2")}) {
      MustSucceed(supervisor.Add(
          {.when = When::kFault, .of = of, .reaction = {.changes = {SetParameter{p, value}, SetParameter{q, value}}}}));
    }
    robot.laser_throws = true;
    robot.scheduler.RunUntil(At(100));
    is_second = true;
    robot.infrared.action = [](Doing&) { throw std::runtime_error("no echo"); };
    robot.scheduler.RunUntil(At(130));
    ASSERT_TRUE(injection);
    injection->End();
    robot.scheduler.RunUntil(At(300));
    EXPECT_EQ(two.p.Get(), 2);
    EXPECT_EQ(two.q.Get(), 2);
    EXPECT_EQ(TextToSave(**robot.runtime.root().Find(p), two.p), "0");
    EXPECT_EQ(TextToSave(**robot.runtime.root().Find(q), two.q), "0");
    if (!injection->has_struck() || ::testing::Test::HasFailure()) break;
  }
}

template <int kNumber>
struct Arm final : Module {
  using Module::Module;
  Parameter<double> p{this, "p", {.default_value = 0}};
  Parameter<double> q{this, "q", {.default_value = 0}};
  void Update() override {}
  static void AddTo(ModuleRegistry& modules) {
    MustSucceed(modules.Add({"test/arm" + std::to_string(kNumber), "", "test",
                             [](const Placement& placement) { return std::make_unique<Arm>(placement); }}));
  }
};

TEST(NotesOfRules, OfReplacementsAreMadeOnceThoughMemoryIsShort) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    Robot robot{SchedulerOptions::ClockKind::kSimulated};
    Arm<1>::AddTo(robot.modules), Arm<2>::AddTo(robot.modules), Arm<3>::AddTo(robot.modules);
    ASSERT_TRUE(robot.editor.Apply({CreateModule{.path = "/two", .type = "test/arm1"}}));
    ASSERT_TRUE(robot.editor.Apply({SetParameter{"/two/p", "7"}, SetParameter{"/two/q", "8"}}));
    bool is_second = false;
    std::optional<FaultInjection> injection;
    Supervisor supervisor{robot.runtime, robot.scheduler, [&](const ChangeSet& changes) -> Result<ChangeSet> {
                            ChangeSet back;
                            const ChangeOutcome outcome = robot.editor.Apply(changes, {}, {}, &back);
                            if (!outcome) return outcome.diagnostics.errors().front();
                            if (is_second && !injection) injection.emplace(InjectedFault::kAllocation, nth);
                            return back;
                          }};
    for (const auto& [of, type, value] :
         {std::tuple(robot.laser.path(), "test/arm2", "1"), std::tuple(robot.infrared.path(), "test/arm3", "3")}) {
      ReplaceModule replace{.path = "/two", .type = type, .settings = {{"p", value}, {"q", value}}};
      MustSucceed(supervisor.Add({.when = When::kFault, .of = of, .reaction = {.changes = {std::move(replace)}}}));
    }
    robot.laser_throws = true;
    robot.scheduler.RunUntil(At(100));
    is_second = true;
    robot.infrared.action = [](Doing&) { throw 7; };
    robot.scheduler.RunUntil(At(130));
    ASSERT_TRUE(injection);
    const bool has_struck = injection->has_struck();
    injection.reset();
    robot.scheduler.RunUntil(At(300));
    for (const auto& [path, value] : {std::pair("/two/p", "7"), std::pair("/two/q", "8")}) {
      FrameworkElement& parameter = **robot.runtime.root().Find(path);
      EXPECT_EQ(TextToSave(parameter, dynamic_cast<const Configurable&>(parameter)), value) << path;
    }
    EXPECT_EQ(MadeByRule::Before(**robot.runtime.root().Find("/two"), "test/arm3"), "test/arm1");
    if (!has_struck || ::testing::Test::HasFailure()) break;
  }
}

// Whatever becomes of the changes.
TEST(ReleasesOfRules, ComeThoughTheErrorOfTheChangesFindsNoMemory) {
  for (std::size_t nth = 1; nth < 10; ++nth) {
    SCOPED_TRACE(nth);
    Robot robot{SchedulerOptions::ClockKind::kSimulated};
    const std::string port = robot.reader.in.path();
    std::optional<FaultInjection> injection;
    Supervisor supervisor{robot.runtime, robot.scheduler, [&](const ChangeSet&) -> Result<ChangeSet> {
                            Error error{.message = "that cannot be changed, as a longer text says"};
                            if (!injection) injection.emplace(InjectedFault::kAllocation, nth);
                            return error;
                          }};
    MustSucceed(supervisor.Add(
        {.of = port,
         .after = 30ms,
         .fresh_after = 50ms,
         .reaction = {.published = {{port, "5"}}},
         .otherwise = {.released = {port}, .changes = Switch(robot.reader.in, robot.laser.out, robot.infrared.out)}}));
    robot.scheduler.RunUntil(At(60));
    robot.laser_works = false;
    robot.scheduler.RunUntil(At(150));
    robot.laser_works = true;
    try {
      robot.scheduler.RunUntil(At(400));
    } catch (const std::bad_alloc&) {
    }
    injection.reset();
    robot.scheduler.RunUntil(At(900));
    EXPECT_EQ(robot.seen, 1);
  }
}

struct Asking final : Module {
  using Module::Module;
  StructureRequest request{this};
  int answers = 0;
  void Update() override {
    if (request.answer() != nullptr) ++answers;
  }
};

TEST(RequestsOfModules, AreServedOnceThoughMemoryIsShort) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    Robot robot{SchedulerOptions::ClockKind::kSimulated};
    int performed = 0;
    robot.before_changes = [&] { ++performed; };
    auto& asking = robot.runtime.Create<Asking>(robot.runtime.root(), "asking");
    MustSucceed(robot.runtime.MakeReady(robot.runtime.root()));
    robot.scheduler.RunUntil(At(60));
    ASSERT_TRUE(asking.request.Ask("disconnect " + robot.laser.out.path() + " " + robot.reader.in.path()));
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      robot.scheduler.RunUntil(At(200));
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    robot.scheduler.RunUntil(At(600));
    ASSERT_GT(asking.answers, 0);
    EXPECT_LE(performed, 1);
    EXPECT_EQ(asking.request.answer()->has_value(), robot.reader.in.Sources().empty());
    if (!injection.has_struck() || ::testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace runnel::supervised
