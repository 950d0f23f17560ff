#include "plugins/command_service/command_service.h"

#include <atomic>
#include <future>
#include <mutex>
#include <new>
#include <semaphore>
#include <string>
#include <thread>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/driving_ports.h"
#include "core/port/input.h"
#include "plugins/structure/change_history.h"

namespace runnel::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Outcome = CommandAnswer::Outcome;

class Idle final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override {}
};

/// An application that nobody runs.
class CommandServiceTest : public ::testing::Test {
 protected:
  CommandServiceTest() {
    EXPECT_TRUE(modules.Add({"test/idle", "", "test", [](const Placement& placement) {
                               return std::unique_ptr<FrameworkElement>(std::make_unique<Idle>(placement));
                             }}));
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
  }

  static CommandAnswer Ask(CommandService& service, CommandRequest request) {
    std::binary_semaphore done(0);
    TaskGroup tasks(service.worker());
    const auto pending = service.Begin(std::move(request), tasks, [&] { done.release(); });
    done.acquire();
    EXPECT_TRUE(pending->is_done());
    return pending->Take();
  }
  CommandAnswer Ask(CommandRequest request) {
    CommandService service(application);
    return Ask(service, std::move(request));
  }
  static ChangeRequest Create(const std::string& path) {
    return {{.changes = {CreateModule{path, "test/idle"}}, .positions = {}}};
  }
  static std::string ErrorOf(const CommandAnswer& answer) {
    return answer.diagnostics.errors().empty() ? "" : answer.diagnostics.errors()[0].message;
  }
  std::vector<std::string> Logged() const {
    std::vector<std::string> texts;
    for (const auto& entry : log.ReadEntries(0, 1000).entries) texts.push_back(entry.text);
    return texts;
  }
  bool Has(const std::string& path) {
    const std::lock_guard lock(runtime.structure_mutex());
    return runtime.root().Find(path).has_value();
  }

  Runtime runtime;
  ModuleRegistry modules;
  StructureEditor editor{runtime, modules, nullptr};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  ServedApplication application{runtime, modules, editor, log, {}, &history};
};

TEST_F(CommandServiceTest, CarriesOutChangesAndTakesThemBack) {
  CommandService service(application);
  EXPECT_EQ(Ask(service, Create("/a")).outcome, Outcome::kDone);
  EXPECT_TRUE(Has("/a"));
  EXPECT_EQ(Ask(service, Create("/a")).outcome, Outcome::kRefused);
  EXPECT_EQ(Ask(service, UndoRequest{}).text, "undone: create /a test/idle");
  EXPECT_FALSE(Has("/a"));
  EXPECT_EQ(Ask(service, RedoRequest{}).text, "redone: create /a test/idle");
  EXPECT_EQ(Ask(service, RedoRequest{}).outcome, Outcome::kRefused);
  EXPECT_THAT(Logged(), ElementsAre("create /a test/idle", HasSubstr("refused: create /a test/idle"),
                                    "undone: create /a test/idle", "redone: create /a test/idle"));
}

TEST_F(CommandServiceTest, SaysWhatTheProgramCannotDo) {
  application.history = nullptr;
  EXPECT_THAT(ErrorOf(Ask(SaveRequest{})), HasSubstr("cannot save it"));
  EXPECT_THAT(ErrorOf(Ask(ReloadRequest{"planning"})), HasSubstr("cannot load plugins anew"));
  EXPECT_THAT(ErrorOf(Ask(UndoRequest{})), HasSubstr("cannot undo changes"));
  EXPECT_EQ(Ask(SaveRequest{}).outcome, Outcome::kRefused);
}

TEST_F(CommandServiceTest, EndsARequestByWhateverAPluginThrowsAndServesTheNext) {
  application.hooks.reload = [](const std::string& plugin) -> Result<std::string> {
    if (plugin == "number") throw 1;
    if (plugin == "memory") throw std::bad_alloc();
    return "loaded " + plugin;
  };
  application.hooks.load_plugins = [](const ChangeSet&) { throw 1; };
  CommandService service(application);
  const CommandAnswer number = Ask(service, ReloadRequest{"number"});
  EXPECT_EQ(number.outcome, Outcome::kFailed);
  EXPECT_EQ(ErrorOf(number), "exception of type int");
  EXPECT_EQ(ErrorOf(Ask(service, ReloadRequest{"memory"})), "std::bad_alloc");
  ChangeRequest unknown{{.changes = {CreateModule{"/a", "other/type"}}, .positions = {}}};
  EXPECT_EQ(ErrorOf(Ask(service, std::move(unknown))), "exception of type int");
  EXPECT_EQ(Ask(service, ReloadRequest{"good"}).text, "loaded good");
}

// A slow constructor, a library that is being loaded: both hold the structure lock, in the worker.
// As while a constructor takes its time.
TEST_F(CommandServiceTest, APortIsBlockedWhileTheWorkerIsBusy) {
  auto& base = runtime.Create<Group>(runtime.root(), "base");
  Input<double> wheels(base, "wheels", {.unit = "m/s"});
  std::promise<void> begun;
  std::promise<void> may_end;
  application.hooks.reload = [&](const std::string&) -> Result<std::string> {
    begun.set_value();
    may_end.get_future().wait();
    return std::string("loaded");
  };
  CommandService service(application);
  TaskGroup tasks(service.worker());
  const auto slow = service.Begin(ReloadRequest{"slow"}, tasks);
  begun.get_future().wait();
  const auto block = service.Begin(BlockRequest{"/base/wheels"}, tasks);
  EXPECT_TRUE(block->is_done());
  EXPECT_TRUE(wheels.is_blocked());
  EXPECT_FALSE(slow->is_done());
  may_end.set_value();
  while (!slow->is_done()) std::this_thread::yield();
}

TEST_F(CommandServiceTest, StopIsInForceWhileTheWorkerAndTheStructureLockAreTaken) {
  std::promise<void> begun;
  std::promise<void> may_end;
  application.hooks.reload = [&](const std::string&) -> Result<std::string> {
    const std::lock_guard lock(runtime.structure_mutex());
    begun.set_value();
    may_end.get_future().wait();
    return std::string("loaded");
  };
  CommandService service(application);
  TaskGroup tasks(service.worker());
  const auto slow = service.Begin(ReloadRequest{"slow"}, tasks);
  begun.get_future().wait();
  int told = 0;
  const auto press = service.Begin(RobotStopRequest{true, "a test"}, tasks, [&] { ++told; });
  EXPECT_TRUE(runtime.robot_stop().in_force());
  EXPECT_TRUE(press->is_done());
  EXPECT_EQ(told, 1);
  EXPECT_THAT(press->Take().text, HasSubstr("STOP is in force;"));
  EXPECT_THAT(service.Begin(RobotStopRequest{true, "another"}, tasks)->Take().text, HasSubstr("already"));
  EXPECT_THAT(service.Begin(RobotStopRequest{false, "a test"}, tasks)->Take().text,
              HasSubstr("the STOP that a test had pressed"));
  EXPECT_FALSE(runtime.robot_stop().in_force());
  EXPECT_THAT(ErrorOf(service.Begin(RobotStopRequest{false, "a test"}, tasks)->Take()), HasSubstr("not in force"));
  EXPECT_FALSE(slow->is_done());
  may_end.set_value();
  EXPECT_THAT(log.ReadEntries(0, 9).entries.back().text, HasSubstr("STOP is released by a test"));
}

TEST_F(CommandServiceTest, SaysWhatStopHoldsOrThatItStopsNothing) {
  CommandService service(application);
  const CommandAnswer nothing = Ask(service, RobotStopRequest{true, "a test"});
  EXPECT_TRUE(nothing.stops_nothing);
  EXPECT_THAT(nothing.diagnostics.ToString(), HasSubstr("STOP stops nothing, and the robot may move"));
  EXPECT_TRUE(runtime.robot_stop().in_force()) << "for ports that come later";
  EXPECT_FALSE(Ask(service, RobotStopRequest{false, "a test"}).stops_nothing);
  auto elsewhere =
      std::make_shared<PortStop>(AnyValue(), Duration{}, DrivingKind::kVelocity, runtime.robot_stop().signal());
  AddWhatDrives(runtime, "/cmd_vel (in the network)", elsewhere);
  const CommandAnswer answer = Ask(service, RobotStopRequest{true, "a test"});
  EXPECT_FALSE(answer.stops_nothing);
  EXPECT_THAT(answer.text, HasSubstr("what drives: /cmd_vel (in the network)"));
  EXPECT_TRUE(CheckThatAllStops(runtime, nullptr));
  elsewhere.reset();
  EXPECT_TRUE(Ask(service, RobotStopRequest{true, "a test"}).stops_nothing);
  const auto all = CheckThatAllStops(runtime, nullptr);
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().message, HasSubstr("STOP is in force, but no port of this application is marked"));
}

TEST_F(CommandServiceTest, SaysWhereTheNextProcessWillNotKnowOfAStopYet) {
  bool is_kept = false;
  application.hooks.is_stop_kept = [&] { return is_kept; };
  CommandService service(application);
  EXPECT_THAT(Ask(service, RobotStopRequest{true, "a test"}).text, HasSubstr("is not written yet"));
  is_kept = true;
  EXPECT_THAT(Ask(service, RobotStopRequest{true, "a test"}).text, ::testing::Not(HasSubstr("is not written yet")));
}

TEST_F(CommandServiceTest, ConfinesWhereClientsOfOthersMaySave) {
  std::string saved;
  application.hooks.save = [&](const std::string& file) -> Result<std::string> {
    saved = file;
    return std::string("saved");
  };
  const CommandAnswer refused =
      Ask(SaveRequest{.file = "/etc/passwd.xml", .is_confined = true, .application_file = ""});
  EXPECT_EQ(refused.outcome, Outcome::kRefused);
  EXPECT_THAT(saved, IsEmpty());
  EXPECT_TRUE(Ask(SaveRequest{.file = "/etc/passwd.xml"}));
  EXPECT_EQ(saved, "/etc/passwd.xml");
}

TEST_F(CommandServiceTest, DeletesTheWholeApplicationOnlyWhenThatIsMeant) {
  CommandService service(application);
  ASSERT_TRUE(Ask(service, ChangeRequest{{.changes = {CreateGroup{"/app"}, CreateModule{"/app/a", "test/idle"}},
                                          .positions = {}}}));
  const ChangeSet deletion{DeleteElement{"app"}};
  const CommandAnswer refused = Ask(service, ChangeRequest{{.changes = deletion, .positions = {}}});
  EXPECT_EQ(refused.outcome, Outcome::kRefused);
  EXPECT_EQ(refused.needs, "yes");
  EXPECT_THAT(ErrorOf(refused), HasSubstr("is the whole application"));
  EXPECT_TRUE(Has("/app"));
  EXPECT_TRUE(Ask(service, ChangeRequest{{.changes = {DeleteElement{"/app/a"}}, .positions = {}}}));
  EXPECT_TRUE(
      Ask(service, ChangeRequest{.placed = {.changes = deletion, .positions = {}}, .may_end_application = true}));
  EXPECT_FALSE(Has("/app"));
}

TEST_F(CommandServiceTest, AsksBeforeAnotherFileIsOverwritten) {
  std::string saved;
  application.hooks.save = [&](const std::string& file) -> Result<std::string> { return saved = file; };
  application.hooks.find_overwritten = [](const SaveRequest& request) -> std::optional<Error> {
    if (request.file != "/x/other.xml") return {};
    return Error{.message = "is another one"};
  };
  const CommandAnswer refused = Ask(SaveRequest{.file = "/x/other.xml"});
  EXPECT_EQ(refused.outcome, Outcome::kRefused);
  EXPECT_EQ(refused.needs, "overwrite");
  EXPECT_THAT(saved, IsEmpty());
  EXPECT_TRUE(Ask(SaveRequest{.file = "/x/other.xml", .overwrites = true}));
  EXPECT_EQ(saved, "/x/other.xml");
  EXPECT_TRUE(Ask(SaveRequest{.file = "/x/new.xml"}));
}

TEST_F(CommandServiceTest, ReloadsOfTwoTransportsNeverRunAtOnce) {
  std::atomic<int> at_once{0};
  std::atomic<bool> have_met{false};
  application.hooks.reload = [&](const std::string&) -> Result<std::string> {
    if (at_once.fetch_add(1) > 0) have_met = true;
    std::this_thread::yield();
    at_once.fetch_sub(1);
    return std::string();
  };
  CommandService service(application);
  const auto transport = [&] {
    for (int i = 0; i < 50; ++i) EXPECT_TRUE(Ask(service, ReloadRequest{"x"}));
  };
  std::thread other(transport);
  transport();
  other.join();
  EXPECT_FALSE(have_met);
}

TEST_F(CommandServiceTest, ARequestThatIsGivenUpBeforeItBeganIsNotDone) {
  CommandService service(application);
  TaskGroup tasks(service.worker());
  std::binary_semaphore may_go(0);
  tasks.Post([&] { may_go.acquire(); });
  (void)service.Begin(Create("/given_up"), tasks);
  may_go.release();
  EXPECT_TRUE(Ask(service, Create("/b")));
  EXPECT_FALSE(Has("/given_up"));
}

}  // namespace
}  // namespace runnel::test
