#include "core/module/group.h"
#include "core/plugin/module_registry.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/tracing/trace_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

TEST_F(Traced, ShowsCyclesUpdatesAndPublicationsOfSimulatedThreads) {
  Begin(ClockKind::kSimulated);
  auto& ticker = Make<Ticker>("ticker");
  auto& listener = Make<Listener>("listener");
  Make<Drive>("drive");
  ASSERT_TRUE(Port::Connect(ticker.out, listener.in));
  auto& main = CreateThread(runtime, "main", {.period = 50ms});
  AssignThread(runtime.root(), main);
  auto& waiting = CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
  AssignThread(listener, waiting);
  Ready();
  ASSERT_TRUE(scheduler->RunUntil(Time(1s)));
  Finish();

  EXPECT_EQ(summary.lost, 0U);
  const auto cycles = EventsOf("cycle");
  EXPECT_EQ(cycles.size(), 40U);
  EXPECT_EQ(ticker.updates, 20);
  EXPECT_EQ(EventsOf("update", "/ticker").size(), 20U);
  EXPECT_EQ(EventsOf("update", "/drive sense").size(), 20U);
  EXPECT_EQ(EventsOf("update", "/drive control").size(), 20U);
  EXPECT_EQ(EventsOf("update", "/listener").size(), 20U);
  EXPECT_EQ(EventsOf("publish", "publish /ticker/output/seldom").size(), 5U);
  EXPECT_EQ(Values("/ticker/output/seldom"), 10U);
  EXPECT_EQ(Values("/ticker/output/out"), 20U);
  EXPECT_EQ(Values("/drive/sensor_output/seen"), 20U);
  ExpectWithin(EventsOf("update"), cycles);
  ExpectWithin(EventsOf("publish"), EventsOf("update"));
  ExpectOneAfterTheOther(cycles);
  ExpectOneAfterTheOther(EventsOf("update"));
  for (const json& each : cycles) {
    const bool is_main = each["tid"] == TrackOf("/threads/main");
    EXPECT_TRUE(is_main || each["tid"] == TrackOf("/threads/waiting"));
    const auto number = each["args"]["number"].get<int>();
    EXPECT_DOUBLE_EQ(each["args"]["simulated_s"], 0.05 * (number - 1));
  }
  for (const json& each : EventsOf("update", "/listener")) {
    EXPECT_EQ(each["tid"], TrackOf("/threads/waiting"));
  }
  EXPECT_EQ(events[0]["name"], "process_name");
  EXPECT_EQ(events[0]["args"]["name"], "runnel test");
  for (const json& each : events) EXPECT_EQ(each["pid"], getpid());
}

TEST_F(Traced, ShowsRealThreads) {
  Begin(ClockKind::kReal);
  auto& ticker = Make<Ticker>("ticker");
  auto& listener = Make<Listener>("listener");
  ASSERT_TRUE(Port::Connect(ticker.out, listener.in));
  AssignThread(ticker, CreateThread(runtime, "main", {.period = 1ms}));
  AssignThread(listener, CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger}));
  Ready();
  ASSERT_TRUE(scheduler->Start());
  WaitUntil("there are a hundred publications", [&] { return ticker.out.publications() >= 100; });
  Finish();
  EXPECT_EQ(summary.lost, 0U);
  EXPECT_EQ(EventsOf("update", "/ticker").size(), static_cast<std::size_t>(ticker.updates));
  EXPECT_EQ(EventsOf("update", "/listener").size(), static_cast<std::size_t>(listener.updates));
  EXPECT_EQ(Values("/ticker/output/out"), ticker.out.publications());
  const auto cycles = EventsOf("cycle");
  ExpectWithin(EventsOf("update"), cycles);
  ExpectOneAfterTheOther(cycles);
  EXPECT_FALSE(cycles[0]["args"].contains("simulated_s"));
}

TEST_F(Traced, CountsWhatIsLost) {
  Begin(ClockKind::kReal, 64, 2ms);
  auto& listener = Make<Listener>("module");
  auto& thread = CreateThread(runtime, "main", {.activation = ThreadOptions::Activation::kFreeRunning});
  Ready();
  ASSERT_TRUE(scheduler->Start());
  WaitUntil("there are ten thousand cycles", [&] { return thread.statistics().cycles >= 10'000; });
  Finish();
  EXPECT_GT(summary.lost, 1000U);
  const std::size_t noted = EventsOf("update").size() + EventsOf("cycle").size();
  EXPECT_EQ(noted + summary.lost, 2 * static_cast<std::uint64_t>(listener.updates));
  std::uint64_t told = 0;
  for (const json& each : EventsOf("tracing", "lost events")) {
    told += each["args"]["count"].get<std::uint64_t>();
  }
  EXPECT_EQ(told, summary.lost);
  EXPECT_EQ(EventsOf("tracing", "end of the trace")[0]["args"]["lost_events"], summary.lost);
}

TEST_F(Traced, ShowsFaultsWithAllOfTheirMessages) {
  Begin(ClockKind::kSimulated);
  Make<Faulty>("faulty");
  Make<Faulty>("faulty_too");
  Ready();
  ASSERT_TRUE(scheduler->RunUntil(Time(100ms)));
  Finish();
  const auto faults = EventsOf("fault");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0]["args"]["module"], "/faulty");
  EXPECT_EQ(faults[0]["args"]["message"], kLongMessage);
  EXPECT_EQ(faults[1]["args"]["module"], "/faulty_too");
  EXPECT_EQ(EventsOf("update", "/faulty").size(), 1U);  // it is stopped then
}

TEST_F(Traced, GoesOnOverSwapsAndOtherChangesOfTheStructure) {
  Begin(ClockKind::kSimulated);
  ModuleRegistry modules;
  ASSERT_TRUE(modules.Add({"test/ticker", "", "test", [](const Placement& placement) {
                             return std::unique_ptr<FrameworkElement>(std::make_unique<Ticker>(placement));
                           }}));
  auto& app = runtime.Create<Group>(runtime.root(), "app");
  ASSERT_TRUE(modules.Create("test/ticker", app, "a"));
  runtime.Create<Listener>(app, "b");
  CreateThread(runtime, "main", {.period = 10ms});
  Ready();
  recorder->FollowStructure();
  StructureEditor editor(runtime, modules, &*scheduler);
  const auto must = [&](const ChangeSet& changes) {
    const auto outcome = editor.Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  };
  const auto run = [&](Duration duration) { ASSERT_TRUE(scheduler->RunUntil(runtime.clock().Now() + duration)); };
  run(100ms);
  must({ConnectPorts{"/app/a/out", "/app/b/in"}});
  must({ReplaceModule{"/app/a", "test/ticker"}});
  run(100ms);
  must({CreateModule{"/app/c", "test/ticker"}});
  run(100ms);
  CreateThread(runtime, "second", {.period = 20ms});
  must({AssignToThread{"/app/c", "second"}});
  run(100ms);
  must({DeleteElement{"/app/a"}});
  run(100ms);
  Finish();
  EXPECT_EQ(EventsOf("update", "/app/a").size(), 40U);
  EXPECT_EQ(Values("/app/a/output/out"), 40U);
  EXPECT_EQ(EventsOf("update", "/app/c").size(), 10U + 5U + 5U);
  EXPECT_EQ(EventsOf("cycle").size(), 50U + 10U);
  const std::vector<std::string> changes{"connected /app/a/output/out to /app/b/input/in",
                                         "put in /app/a (test/ticker)", "put in /app/c (test/ticker)",
                                         "took out /app/a"};
  for (const std::string& each : changes) {
    EXPECT_GE(EventsOf("structure", each).size(), 1U) << each;
  }
  const auto holds = EventsOf("hold");
  ASSERT_GE(holds.size(), 4U);
  EXPECT_EQ(holds[0]["args"]["thread"], "/threads/main");
  EXPECT_DOUBLE_EQ(holds[0]["args"]["simulated_s"], 0.1);
  ExpectWithin(EventsOf("update"), EventsOf("cycle"));
}

TEST_F(Traced, IsInTheFileSoonAfterItHasHappened) {
  Begin(ClockKind::kSimulated);
  Make<Ticker>("ticker");
  Ready();
  ASSERT_TRUE(scheduler->RunUntil(Time(1s)));
  // Nothing is closed, as if the program had been killed.
  WaitUntil("the updates are in the file", [&] {
    std::ifstream stream(path);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    // Nothing may have been written yet, or half of what is just being written.
    const json found = json::parse(text + "]", nullptr, false);
    events = found.is_discarded() ? json::array() : found;
    return EventsOf("update", "/ticker").size() >= 20;
  });
}

TEST_F(Traced, AllocatesNothingInItsCycles) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "sanitizers have a malloc of their own";
  Begin(ClockKind::kSimulated);
  auto& ticker = Make<Ticker>("ticker");
  auto& listener = Make<Listener>("listener");
  ASSERT_TRUE(Port::Connect(ticker.out, listener.in));
  AssignThread(listener, CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger}));
  AssignThread(ticker, CreateThread(runtime, "main", {.period = 1ms}));
  Ready();
  ASSERT_TRUE(scheduler->RunUntil(Time(20ms)));
  const AllocationGuard guard;
  const bool has_run = scheduler->RunUntil(Time(1s));
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(has_run);
  Finish();
  EXPECT_EQ(EventsOf("update", "/listener").size(), static_cast<std::size_t>(listener.updates));
  EXPECT_GT(listener.updates, 900);
}

TEST_F(Traced, ChangesNothingOfWhatIsComputed) {
  const auto values = [](Runtime& in, Scheduler& by) {
    auto& ticker = in.Create<Ticker>(in.root(), "ticker");
    auto& listener = in.Create<Listener>(in.root(), "listener");
    EXPECT_TRUE(Port::Connect(ticker.out, listener.in));
    EXPECT_TRUE(in.MakeReady(in.root()));
    EXPECT_TRUE(by.RunUntil(Time(1s)));
    return std::pair(ticker.updates, listener.updates);
  };
  Begin(ClockKind::kSimulated);
  const auto traced = values(runtime, *scheduler);
  Runtime other_runtime;
  Scheduler other(other_runtime, {.clock = ClockKind::kSimulated});
  EXPECT_EQ(values(other_runtime, other), traced);
}

}  // namespace
}  // namespace runnel::test
