// What people read of values and states: numbers, ages, what is stopped, what lacks a connection.

#include "core/base/clock.h"
#include "plugins/control/application_state.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"
#include "tests/plugins/control/control_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using ::testing::Not;

TEST(ReadableNumbersTest, HaveSixDigitsOutsideOfQuotationMarks) {
  EXPECT_EQ(ReadableNumbers("{forward: 0.39933782972553455, turn: -0.00397302164679287}"),
            "{forward: 0.399338, turn: -0.00397302}");
  EXPECT_EQ(ReadableNumbers("[1234567890123, 0.1, 1e-07, 1.23456789e+22]"), "[1234567890123, 0.1, 1e-07, 1.23457e+22]");
  EXPECT_EQ(ReadableNumbers("{name: \"v0.123456789 \\\"0.123456789\\\"\", x: 2}"),
            "{name: \"v0.123456789 \\\"0.123456789\\\"\", x: 2}");
  EXPECT_EQ(ReadableNumbers("left_0.12345678 v1.23456789"), "left_0.12345678 v1.23456789");
  EXPECT_EQ(ReadableNumbers("1.23456789s"), "1.23457s");
  EXPECT_EQ(ReadableNumbers("192.168.100.10"), "192.168.100.10") << "an address is no number";
  EXPECT_EQ(ReadableNumbers("2.20240101.5 -.123456789"), "2.20240101.5 -.123456789");
  EXPECT_EQ(ReadableNumbers(""), "");
  EXPECT_EQ(ReadableNumbers("\""), "\"");
}

TEST_F(ControlTest, GetsOneValue) {
  ASSERT_EQ(Change("set /a/speed 0.123456789").code, 0);
  EXPECT_EQ(Ask("get /a/speed").output, "0.123457\n");
  EXPECT_EQ(Ask("get /app/a/parameter/speed full=yes").output, "0.123456789\n");
  WaitUntil("something is published", [&] { return Ask("get /a/out").code == 0; });
  EXPECT_THAT(Ask("get /a/out").output, ::testing::ContainsRegex("^[0-9]+\n$"));
  EXPECT_THAT(Ask("get /a/spede").errors, HasSubstr("did you mean 'speed'?"));
  ASSERT_EQ(Change("create /silent test/failing").code, 0);
  const Told nothing = Ask("get /silent/out");
  EXPECT_NE(nothing.code, 0);
  EXPECT_THAT(nothing.errors, HasSubstr("nothing has been published there yet"));
}

/// Publishes only what somebody wants to see, as `genom_state` of components and drawings of planners are.
class Unasked final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  void Update() override {
    if (out.is_watched()) out.Publish(7);
  }
};

TEST_F(ControlTest, GettingIsLookingForWhatIsPublishedOnlyThen) {
  Register<Unasked>("test/unasked");
  ASSERT_EQ(Change("create /got test/unasked; create /shown test/unasked").code, 0);
  const Told got = Ask("get /got/out");
  EXPECT_EQ(got.output, "7\n") << got.errors;
  EXPECT_THAT(Ask("echo /shown/out count=1").output, HasSubstr("7"));
}

TEST_F(ControlTest, ListsWhatHasFailed) {
  EXPECT_THAT(Ask("ls").output, Not(HasSubstr("FAILED")));
  ASSERT_EQ(Change("create /worn test/failing").code, 0);
  const auto is_stopped = [&] {
    for (const Fault& fault : scheduler.TakeFaults()) {
      log.Add(ApplicationLog::Kind::kFault, fault.path + " is worn", fault.path, fault.message);
    }
    return Ask("ls /worn").output.find("FAILED: is worn out") != std::string::npos;
  };
  WaitUntil("the module is stopped", is_stopped);
  EXPECT_THAT(Client().hello().state, HasSubstr("1 module FAILED"));
}

// On a clock of its own: an output that published every 100 ms, one that published twice, and one that did so while a
// viewer was there, who has gone.
TEST(SilenceTest, IsToldOfWhatPublishedSteadilyAndDoesSoNoMore) {
  ManualClock clock;
  Runtime runtime;
  runtime.set_clock(clock);
  auto& steady = runtime.Create<Counter>(runtime.root(), "steady");
  auto& seldom = runtime.Create<Counter>(runtime.root(), "seldom");
  auto& watched = runtime.Create<Counter>(runtime.root(), "watched");
  auto& sink = runtime.Create<Sink>(runtime.root(), "sink");
  ASSERT_TRUE(Port::Connect(steady.out, sink.in));
  ASSERT_TRUE(Port::Connect(seldom.out, sink.in));
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  for (int i = 1; i <= 40; ++i) {
    clock.Advance(100ms);
    steady.out.Publish(i);
    watched.out.Publish(i);
    if (i % 20 == 0) seldom.out.Publish(i);
  }
  const std::lock_guard lock(runtime.structure_mutex());
  const auto listed = [&] { return ListElements(runtime.root(), {.now = clock.Now()}); };
  clock.Advance(1400ms);
  EXPECT_THAT(listed(), Not(HasSubstr("SILENT")));
  clock.Advance(600ms);
  EXPECT_THAT(listed(), HasSubstr("SILENT for 2 s"));
  EXPECT_TRUE(SilentFor(steady.out, Time{}, clock.Now()));
  EXPECT_FALSE(SilentFor(seldom.out, Time{}, clock.Now()));
  EXPECT_FALSE(SilentFor(watched.out, Time{}, clock.Now()));
  steady.out.Publish(41);
  EXPECT_THAT(listed(), AllOf(Not(HasSubstr("SILENT")), Not(HasSubstr("STAMPED AHEAD"))));
  steady.out.Publish(42, clock.Now() + 1s);
  EXPECT_THAT(listed(), HasSubstr("STAMPED AHEAD"));
}

// Of an application that nobody runs.
TEST(SilenceTest, IsCountedInTheStateOfTheApplication) {
  ManualClock clock;
  Runtime runtime;
  runtime.set_clock(clock);
  ModuleRegistry modules;
  Scheduler scheduler(runtime);
  StructureEditor editor(runtime, modules, &scheduler);
  ApplicationLog log(runtime.clock());
  const ServedApplication application{
      .runtime = runtime, .modules = modules, .editor = editor, .log = log, .scheduler = &scheduler};
  auto& app = runtime.Create<Group>(runtime.root(), "app");
  AssignThread(app, CreateThread(runtime, "main", {.period = 1ms}));
  auto& counter = runtime.Create<Counter>(app, "counter");
  auto& other = runtime.Create<Counter>(app, "other");
  auto& sink = runtime.Create<Sink>(app, "sink");
  ASSERT_TRUE(Port::Connect(counter.out, sink.in));
  ASSERT_TRUE(Port::Connect(other.out, sink.in));
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  for (int i = 1; i <= 40; ++i) {
    clock.Advance(100ms);
    counter.out.Publish(i);
    other.out.Publish(i);
  }
  EXPECT_EQ(StateText(application), "running");
  clock.Advance(1s);
  other.out.Publish(41);
  clock.Advance(1s);
  EXPECT_EQ(StateText(application), "running, 1 output SILENT");
  clock.Advance(1s);
  EXPECT_EQ(StateText(application), "running, 2 outputs SILENT");
  counter.out.Publish(41);
  other.out.Publish(42);
  EXPECT_EQ(StateText(application), "running");
}

TEST_F(ControlTest, MakesAStoppedModuleAnew) {
  ASSERT_EQ(Change("create /worn test/failing").code, 0);
  const auto is_stopped = [&] { return Ask("ls /worn").output.find("FAILED") != std::string::npos; };
  WaitUntil("the module is stopped", is_stopped);
  const auto id = [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    return (*runtime.root().Find("/app/worn"))->id();
  };
  const auto before = id();
  // It fails again, so the one before comes back: what counts is that it was made anew.
  EXPECT_THAT(Ask("restart /worn").errors, HasSubstr("the old one is back"));
  EXPECT_EQ(id(), before);
  EXPECT_EQ(Ask("restart /a").code, 0);
  EXPECT_THAT(Ask("restart /app/b/in").errors, HasSubstr("neither a module nor a group"));
  EXPECT_THAT(Ask("restart").errors, HasSubstr("cannot run it again"));
  EXPECT_THAT(Ask("quit").errors, HasSubstr("cannot end its run"));
}

TEST_F(ControlTest, RenamesAndCopies) {
  EXPECT_EQ(Change("rename /a first; copy /first").code, 0);
  EXPECT_THAT(Ask("ls").output, HasSubstr("first_2"));
  EXPECT_THAT(Ask("ls /a").errors, HasSubstr("no 'a' in /app"));
  EXPECT_EQ(Ask("undo").code, 0);
  EXPECT_EQ(Ask("ls /a").code, 0);
}

TEST_F(ControlTest, SaysWhereANameIsDeeperInTheTree) {
  ASSERT_EQ(Change("create group /deep; create /deep/inner test/counter").code, 0);
  EXPECT_THAT(Ask("echo inner/out count=1").errors, HasSubstr("did you mean /app/deep/inner/out?"));
}

TEST_F(ControlTest, CountsTimesFromTheStartOfTheApplication) {
  const Told told = Ask("echo /a/out count=1");
  EXPECT_LT(std::stod(told.output), 3600) << "not since the machine has started";
}

TEST_F(ControlTest, SaysHowEvenlyValuesCome) {
  EXPECT_THAT(Ask("hz /a/out count=1").output, HasSubstr(" Hz, "));
  const RunningApplication first{"a.sock", {.process = 1, .application = "one"}};
  const RunningApplication second{"b.sock", {.process = 2, .application = "one"}};
  const RunningApplication third{"c.sock", {.process = 3, .application = "two"}};
  EXPECT_THAT(ChooseApplication({first, second, third}, "one").error().message,
              HasSubstr("2 applications called 'one' are running: one (1), one (2)"));
}

}  // namespace
}  // namespace runnel::test
