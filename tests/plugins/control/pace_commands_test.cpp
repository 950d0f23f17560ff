#include <atomic>

#include "tests/plugins/control/control_fixture.h"

namespace runnel::test {
namespace {

TEST_F(ControlTest, CannotPauseRealTime) {
  for (const std::string request : {"pause", "resume", "step 2", "speed 2"}) {
    const Told told = Ask(request);
    EXPECT_EQ(told.code, 2) << request;
    EXPECT_THAT(told.errors, HasSubstr("error: real time cannot be ")) << request;
    EXPECT_THAT(told.errors, HasSubstr("<clock type=\"simulated\"/>")) << request;
  }
  EXPECT_EQ(Ask("speed").output, "as fast as real time\n");
}

/// An application on a simulated clock, which begins with a pause, with a server.
class PacedControlTest : public ::testing::Test {
 protected:
  PacedControlTest() {
    CreateThread(runtime, "main", {.period = 10ms});
    counter = &runtime.Create<Counter>(runtime.root(), "counter");
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    auto started = ControlServer::Start(service, {.application = "app", .folder = folder.path() / "runnel"});
    EXPECT_TRUE(started) << started.error().ToString();
    server = std::move(*started);
    running = std::thread([this] {
      while (scheduler.Step()) {
      }
    });
  }
  ~PacedControlTest() override {
    server.reset();
    scheduler.RequestStop();
    running.join();
  }

  Told Ask(const std::string& request) {
    auto client = ControlClient::Connect(server->socket());
    EXPECT_TRUE(client) << client.error().ToString();
    return test::Ask(*client, request);
  }

  TemporaryFolder folder;
  Runtime runtime;
  ModuleRegistry modules;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated, .is_paused = true}};
  StructureEditor editor{runtime, modules, &scheduler};
  ApplicationLog log{runtime.clock()};
  CommandService service{
      {.runtime = runtime, .modules = modules, .editor = editor, .log = log, .pace = &scheduler.pace()}};
  Counter* counter = nullptr;
  std::unique_ptr<ControlServer> server;
  std::thread running;
};

TEST_F(PacedControlTest, StepsCycleByCycleAndIsAnsweredWhenTheyHaveRun) {
  EXPECT_EQ(Ask("step").output, "stands at 0.000 s\n");
  EXPECT_EQ(counter->out.publications(), 1U);
  EXPECT_EQ(Ask("step 5").output, "stands at 0.050 s\n");
  EXPECT_EQ(counter->out.publications(), 6U);
}

TEST_F(PacedControlTest, PausesAndGoesOn) {
  EXPECT_THAT(Ask("speed").output, HasSubstr("as fast as it can, but paused"));
  EXPECT_EQ(Ask("resume").code, 0);
  EXPECT_FALSE(scheduler.pace().is_paused());
  EXPECT_EQ(Ask("pause").code, 0);
  EXPECT_TRUE(scheduler.pace().is_paused());
  EXPECT_THAT(Ask("log").output, HasSubstr("resumed"));
  EXPECT_THAT(Ask("log").output, HasSubstr("paused"));
}

TEST_F(PacedControlTest, ChangesTheSpeed) {
  EXPECT_THAT(Ask("speed 2.5").output, HasSubstr("2.5 times as fast as real time at 0.000 s"));
  EXPECT_EQ(scheduler.pace().speed(), 2.5);
  EXPECT_THAT(Ask("speed").output, HasSubstr("2.5 times as fast as real time, but paused"));
}

TEST_F(PacedControlTest, RefusesWhatIsNoCountOrSpeed) {
  for (const std::string request :
       {"step 0", "step x", "step 2x", "speed fast", "speed -1", "speed nan", "speed 1e9", "pause now", "step 1 2"}) {
    const Told told = Ask(request);
    EXPECT_EQ(told.code, 2) << request;
    EXPECT_THAT(told.errors, HasSubstr("error: ")) << request;
  }
  EXPECT_EQ(scheduler.pace().speed(), 0);
  EXPECT_EQ(counter->out.publications(), 0U);
}

TEST_F(PacedControlTest, ChangesTheStructureInAPause) {
  const Told told = Ask("change\nset /counter/speed 3");
  EXPECT_EQ(told.code, 0) << told.errors;
  EXPECT_EQ(counter->speed.Get(), 3);
  EXPECT_EQ(counter->out.publications(), 0U);
}

}  // namespace
}  // namespace runnel::test
