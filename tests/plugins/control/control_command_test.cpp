#include "core/log/log_level.h"
#include "tests/plugins/control/control_fixture.h"

namespace runnel::test {

TEST_F(ControlTest, SaysWhomAClientHasReached) {
  const auto client = Client();
  EXPECT_EQ(client.hello().application, "app");
  EXPECT_EQ(client.hello().process, getpid());
  const auto running = FindRunningApplications(folder.path() / "runnel");
  ASSERT_TRUE(running);
  ASSERT_THAT(*running, SizeIs(1));
  EXPECT_TRUE(ChooseApplication(*running, ""));
  EXPECT_TRUE(ChooseApplication(*running, "app"));
  EXPECT_TRUE(ChooseApplication(*running, std::to_string(getpid())));
  EXPECT_THAT(ChooseApplication(*running, "ap").error().hint, HasSubstr("did you mean 'app'?"));
}

TEST_F(ControlTest, AsksWhichOfSeveralIsMeant) {
  const RunningApplication first{"a.sock", {.process = 1, .application = "one"}};
  const RunningApplication second{"b.sock", {.process = 2, .application = "two"}};
  EXPECT_THAT(ChooseApplication({first, second}, "").error().message,
              HasSubstr("2 applications are running: one (1), two (2)"));
  EXPECT_EQ(ChooseApplication({first, second}, "two")->socket, "b.sock");
  EXPECT_EQ(ChooseApplication({first, second}, "1")->socket, "a.sock");
  EXPECT_THAT(ChooseApplication({}, "").error().message, HasSubstr("no application is running"));
}

TEST_F(ControlTest, ListsTheTree) {
  const Told told = Ask("ls");
  EXPECT_EQ(told.code, 0) << told.errors;
  EXPECT_THAT(told.output, HasSubstr("module     test/counter"));
  EXPECT_THAT(told.output, HasSubstr("parameter  double = 1 m/s, in 0 .. 9 m/s"));
  EXPECT_THAT(told.output, HasSubstr("thread     every 1ms"));
}

TEST_F(ControlTest, ListsConnectionsRatesAndCyclesToo) {
  ASSERT_EQ(Change("connect /a/out /b/in queue=3").code, 0);
  const Told told = Ask("ls /app long=yes");
  EXPECT_EQ(told.code, 0) << told.errors;
  EXPECT_THAT(told.output, HasSubstr("from /app/a/output/out"));
  EXPECT_THAT(told.output, HasSubstr("to /app/b/input/in (queue 3)"));
  EXPECT_THAT(told.output, HasSubstr(" Hz"));
  EXPECT_THAT(told.output, HasSubstr("run by main"));
  EXPECT_THAT(Ask("ls /threads long=yes").output, HasSubstr(" cycles, "));
}

TEST_F(ControlTest, ListsPathsAndTypesForPrograms) {
  EXPECT_THAT(Ask("paths").output, HasSubstr("output\t/app/a/output/out\t\tint32\n"));
  EXPECT_THAT(Ask("types").output, HasSubstr("test/counter\tdoes it\n"));
}

TEST_F(ControlTest, ShowsValuesOneAfterTheOther) {
  const Told told = Ask("echo /a/out count=3");
  EXPECT_EQ(told.code, 0) << told.errors;
  EXPECT_EQ(std::count(told.output.begin(), told.output.end(), '\n'), 3);
  EXPECT_THAT(told.output, HasSubstr(" s  "));
}

TEST_F(ControlTest, ShowsWhenAValueWasMeasured) {
  ASSERT_EQ(Change("create /late test/lagging").code, 0);
  EXPECT_THAT(Ask("echo /late/out count=1").output,
              ::testing::ContainsRegex("^[0-9.]+ s  \\(measured at -?[0-9.]+ s\\)  7\n"));
  EXPECT_THAT(Ask("echo /a/out count=1").output, ::testing::Not(HasSubstr("measured")));
  // For programs the same words each time, so that no text of a value is taken for them.
  EXPECT_THAT(Ask("echo /a/out count=1 full=yes").output,
              ::testing::ContainsRegex("^[0-9.]+ s  \\(measured at -?[0-9.]+ s, 0 not shown\\)  [0-9]+\n"));
}

TEST_F(ControlTest, ShowsValuesOfInputsAndShortensLongOnes) {
  ASSERT_EQ(Change("connect a/out b/in; create /image test/image").code, 0);
  EXPECT_EQ(Ask("echo /b/in count=1").code, 0);
  EXPECT_THAT(Ask("echo /image/image count=1").output, HasSubstr("7, … 100000 in all]"));
  EXPECT_GT(Ask("echo /image/image count=1 full=yes").output.size(), 300'000U);
}

TEST_F(ControlTest, TellsOfConnectionsThatWaitAndOfConversions) {
  EXPECT_EQ(Change("connect /driver/out /b/in when=present").code, 0);
  EXPECT_THAT(Ask("ls").output, HasSubstr("connection  waits: "));
  EXPECT_THAT(Ask("ls /b").output, HasSubstr("waits for /driver/out"));
  EXPECT_EQ(Change("disconnect /driver/out /b/in").code, 0);
  EXPECT_THAT(Ask("ls").output, ::testing::Not(HasSubstr("waits")));
  ASSERT_EQ(Change("create /image test/image").code, 0);
  EXPECT_THAT(Change("connect /image/image /b/in").errors, HasSubstr("what would fit: from="));
}

TEST_F(ControlTest, EndsShowingWhenThePortIsDeleted) {
  auto client = Client();
  std::string output;
  std::string errors;
  const auto code = client.Ask(
      "echo /a/out",
      [&](std::string_view text) {
        if (output.empty()) {
          EXPECT_EQ(Change("delete /a").code, 0);
        }
        output += text;
        return true;
      },
      [&](std::string_view text) {
        errors += text;
        return true;
      });
  ASSERT_TRUE(code);
  EXPECT_EQ(*code, 1);
  EXPECT_THAT(errors, HasSubstr("no 'a' in"));
}

TEST_F(ControlTest, CountsAtThePublisher) {
  const Told told = Ask("hz /a/out count=1");
  EXPECT_EQ(told.code, 0) << told.errors;
  EXPECT_THAT(told.output, HasSubstr(" Hz, "));
  const std::lock_guard lock(runtime.structure_mutex());
  const auto port = runtime.root().Find("/app/a/output/out");
  ASSERT_TRUE(port);
  EXPECT_TRUE(dynamic_cast<Port&>(**port).outgoing().empty());
}

TEST_F(ControlTest, CarriesOutChangesTogetherOrNotAtAll) {
  const Told refused = Ask("change file=plan.txt\ncreate /c test/counter\nset /c/parameter/sped 3\n");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("did you mean 'speed'?"));
  EXPECT_EQ(Ask("ls /c").code, 2);
  const Told unreadable = Ask("change file=plan.txt\ncreate /c test/counter\n  sett /c 3\n");
  EXPECT_EQ(unreadable.code, 2);
  EXPECT_EQ(unreadable.errors, "plan.txt:2:3: error: there is no change 'sett'; did you mean 'set'?\n");
  const Told done = Change("create /c test/counter speed=2\nconnect /c/out /b/in");
  EXPECT_EQ(done.code, 0) << done.errors;
  EXPECT_THAT(Ask("ls /c").output, HasSubstr("double = 2 m/s"));
}

TEST_F(ControlTest, TellsThatTheOldModuleIsBack) {
  const Told failed = Change("replace /a with test/failing probation=8");
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.errors, HasSubstr("the old one is back"));
  EXPECT_THAT(Ask("ls /a").output, HasSubstr("test/counter"));
  const Told worked = Change("replace /a with test/counter probation=8");
  EXPECT_EQ(worked.code, 0) << worked.errors;
  EXPECT_THAT(worked.output, HasSubstr("done; threads stood still"));
}

TEST_F(ControlTest, NamesWhatIsNearestToWhatIsWrong) {
  EXPECT_THAT(Ask("ehco /a/out").errors, HasSubstr("did you mean 'echo'?"));
  EXPECT_THAT(Ask("echo /a/oot").errors, HasSubstr("did you mean 'out'?"));
  EXPECT_THAT(Ask("echo /x/out").errors, HasSubstr("no 'x' in /app"));
  EXPECT_THAT(Ask("echo /a/out cuont=2").errors, HasSubstr("did you mean 'count'?"));
  EXPECT_THAT(Ask("echo /a/out count=0").errors, HasSubstr("is not a count"));
  EXPECT_THAT(Ask("echo").errors, HasSubstr("wants a path"));
  EXPECT_THAT(Ask("ls /a /b").errors, HasSubstr("one word too many"));
  EXPECT_THAT(Ask("echo /a/parameter/speed").errors, HasSubstr("is not a port"));
  EXPECT_THAT(Ask("ls \"").errors, HasSubstr("not closed"));
  EXPECT_EQ(Ask("").code, 2);
}

TEST_F(ControlTest, KeepsALogOfFaultsAndChanges) {
  log.Add(ApplicationLog::Kind::kFault, "/app/a: has failed: boom\n");
  ASSERT_EQ(Change("set /a/parameter/speed 4").code, 0);
  ASSERT_EQ(Change("set /a/parameter/speed 44").code, 2);
  const auto other = modules.Create("test/counter", **runtime.root().Find("/app"), "other");
  ASSERT_TRUE(other);
  ASSERT_TRUE(runtime.MakeReady(**other));
  const Told told = Ask("log");
  EXPECT_EQ(told.code, 0);
  EXPECT_THAT(told.output, HasSubstr("fault    /app/a: has failed: boom\n"));
  EXPECT_THAT(told.output, HasSubstr("change   set /a/parameter/speed 4\n"));
  EXPECT_THAT(told.output, HasSubstr("change   refused: set /a/parameter/speed 44\n"));
  EXPECT_THAT(told.output, HasSubstr("change   put in /app/other (test/counter)\n"));
}

TEST_F(ControlTest, SaysFromWhichLevelOnModulesAreLogged) {
  EXPECT_EQ(Ask("log level=/a=debug").output, "/app/a: logs debug and more\n");
  EXPECT_EQ(Ask("log level=error").output, "/: logs error and more\n");
  EXPECT_THAT(ReadLogLevels(runtime),
              testing::ElementsAre(testing::Pair("", LogLevel::kError), testing::Pair("/app/a", LogLevel::kDebug)));
  EXPECT_EQ(Ask("log level=/a=inherit").output, "/app/a: logs as what is around it\n");
  EXPECT_THAT(ReadLogLevels(runtime), testing::ElementsAre(testing::Pair("", LogLevel::kError)));
  EXPECT_THAT(Ask("undo").output, HasSubstr("undone: log /a inherit"));
  EXPECT_THAT(ReadLogLevels(runtime), testing::SizeIs(2));
  EXPECT_EQ(Ask("redo").code, 0);
  EXPECT_THAT(Ask("log level=/a=loud").errors, HasSubstr("there is no log level 'loud'"));
  EXPECT_THAT(Ask("log level=/aa=info").errors, HasSubstr("did you mean 'a'?"));
  EXPECT_EQ(Ask("log level=/aa=info").code, 2);
}

TEST_F(ControlTest, FollowsTheLog) {
  log.Add(ApplicationLog::Kind::kWarning, "first");
  auto client = Client();
  std::string output;
  (void)client.Ask(
      "log follow=yes",
      [&](std::string_view text) {
        output += text;
        if (output.find("second") != std::string::npos) return false;
        log.Add(ApplicationLog::Kind::kWarning, "second");
        return true;
      },
      [](std::string_view) { return true; });
  EXPECT_THAT(output, HasSubstr("second"));
}

TEST_F(ControlTest, SavesIfItsProgramCan) {
  EXPECT_THAT(Ask("save x").errors, HasSubstr("cannot save"));
  hooks.save = [](const std::string& file) -> Result<std::string> {
    if (file == "bad") return Error{.message = "disk full"};
    return "saved to " + file;
  };
  hooks.save_configuration = [](const std::string& file) -> Result<std::string> { return "saved values to " + file; };
  StartServer({.application = "app", .folder = folder.path() / "runnel"});
  EXPECT_EQ(Ask("save good").output, "saved to good\n");
  EXPECT_EQ(Ask("save bad").code, 1);
  EXPECT_THAT(Ask("save bad").errors, HasSubstr("disk full"));
  EXPECT_EQ(Ask("save car config=yes").output, "saved values to car\n");
}

TEST_F(ControlTest, LoadsThePluginsThatTypesNeed) {
  std::vector<std::string> asked;
  hooks.load_plugins = [&](const ChangeSet& changes) {
    for (const auto& each : changes) asked.push_back(std::get<CreateModule>(each).type);
    if (asked.back() == "more/counter") Register<Counter>("more/counter");
  };
  StartServer({.application = "app", .folder = folder.path() / "runnel"});
  EXPECT_EQ(Change("create /m more/counter").code, 0);
  EXPECT_EQ(Change("create /n none/counter").code, 2);
  EXPECT_EQ(Change("create /o test/counter; create /p test/sink").code, 0);
  EXPECT_THAT(asked, ::testing::ElementsAre("more/counter", "none/counter", "test/counter", "test/sink"));
}

TEST_F(ControlTest, AnswersSeveralRequestsOneAfterTheOther) {
  const int client = RawClient();
  SendAll(client, FrameBytes("request", "paths") + FrameBytes("request", "types") + FrameBytes("request", "nonsense"));
  shutdown(client, SHUT_WR);
  const std::string all = ReadAll(client);
  const auto ends = [&](const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(ends("end 1\n0\n"), 2U) << all;
  EXPECT_EQ(ends("end 1\n2\n"), 1U) << all;
  close(client);
}

// The simulated clock runs as fast as it can in a thread of the test's.
TEST(SimulatedControl, IsReachedWhileTimeRunsAsFastAsItCan) {
  TemporaryFolder folder;
  Runtime runtime;
  ModuleRegistry modules;
  ASSERT_TRUE(modules.Add({"test/counter", "", "test", [](const Placement& placement) {
                             return std::unique_ptr<FrameworkElement>(std::make_unique<Counter>(placement));
                           }}));
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  auto& app = runtime.Create<Group>(runtime.root(), "app");
  ASSERT_TRUE(modules.Create("test/counter", app, "a"));
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  StructureEditor editor(runtime, modules, &scheduler);
  ApplicationLog log(runtime.clock());
  CommandService service({runtime, modules, editor, log});
  auto server = ControlServer::Start(service, {.application = "app", .folder = folder.path() / "runnel"});
  ASSERT_TRUE(server);
  std::atomic<bool> ends{false};
  std::thread runner([&] {
    while (!ends.load()) scheduler.Step();
  });
  {
    auto client = ControlClient::Connect((*server)->socket());
    ASSERT_TRUE(client);
    EXPECT_EQ(test::Ask(*client, "echo /a/out count=3").code, 0);
    EXPECT_EQ(test::Ask(*client, "ls long=yes").code, 0);
    for (int i = 0; i < 20; ++i) {
      const Told told = test::Ask(*client, "change\nset /a/parameter/speed 2; create /b test/counter");
      EXPECT_EQ(told.code, 0) << told.errors;
      EXPECT_EQ(test::Ask(*client, "change\nreplace /b with test/counter probation=3").code, 0);
      EXPECT_EQ(test::Ask(*client, "change\ndelete /b").code, 0);
    }
    EXPECT_THAT(test::Ask(*client, "hz /a/out count=1").output, HasSubstr("of the application's time"));
  }
  server->reset();
  ends.store(true);
  runner.join();
}

TEST_F(ControlTest, UndoesAndRedoesWhatClientsHaveChanged) {
  EXPECT_THAT(Ask("undo").errors, HasSubstr("there is nothing to be undone"));
  ASSERT_EQ(Change("set /a/speed 3; connect /a/out /b/in queue=4").code, 0);
  const Told undone = Ask("undo");
  EXPECT_EQ(undone.code, 0) << undone.errors;
  EXPECT_EQ(undone.output, "undone: set /a/speed 3 and 1 more\n");
  EXPECT_THAT(Ask("ls /a long=yes").output, HasSubstr("double = 1 m/s"));
  EXPECT_THAT(Ask("ls /a long=yes").output, Not(HasSubstr("queue 4")));
  EXPECT_EQ(Ask("redo").output, "redone: set /a/speed 3 and 1 more\n");
  EXPECT_THAT(Ask("ls /a long=yes").output, HasSubstr("(queue 4)"));
  EXPECT_EQ(Ask("redo").code, 2);
  EXPECT_THAT(Ask("log").output, HasSubstr("undone: set /a/speed 3 and 1 more"));
}

TEST_F(ControlTest, SaysWhyAChangeCannotBeUndone) {
  ASSERT_EQ(Change("create /c test/counter").code, 0);
  ASSERT_TRUE(editor.Apply({DeleteElement{"/c"}}));
  const Told told = Ask("undo");
  EXPECT_EQ(told.code, 2);
  EXPECT_THAT(told.errors, HasSubstr("no 'c' in /"));
  EXPECT_THAT(told.errors, HasSubstr("can no longer be undone, and is forgotten"));
}

}  // namespace runnel::test
