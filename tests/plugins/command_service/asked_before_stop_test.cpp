// What was asked for before a STOP is not carried out after it, unless nothing can move by it.

#include <semaphore>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/command_service/command_service.h"
#include "plugins/command_service/request_table.h"
#include "plugins/structure/change_history.h"

namespace runnel::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Outcome = CommandAnswer::Outcome;

class DrivenBase final : public Module {
 public:
  using Module::Module;
  Input<double> wheels{this, "wheels", {.unit = "m/s", .drives = true}};
  Output<double> speed{this, "speed"};

 private:
  void Update() override {}
};

std::binary_semaphore being_made{0};
std::binary_semaphore may_be_made{0};

/// Its constructor takes as long as the test wants.
class SlowlyMade final : public Module {
 public:
  explicit SlowlyMade(const Placement& placement) : Module(placement) {
    being_made.release();
    may_be_made.acquire();
  }

 private:
  void Update() override {}
};

class AskedBeforeStop : public ::testing::Test {
 protected:
  AskedBeforeStop() {
    Register<DrivenBase>("test/base");
    Register<SlowlyMade>("test/slow");
    for (const char* const name : {"a", "b"}) EXPECT_TRUE(modules.Create("test/base", runtime.root(), name));
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    application.hooks.reload = application.hooks.save = [this](const std::string& name) -> Result<std::string> {
      done.push_back(name);
      return name;
    };
    application.hooks.restart = [this] { return application.hooks.save("restart"); };
    application.hooks.quit = [this] { return application.hooks.save("quit"); };
    application.hooks.set_paused = [this](const std::string&, bool is_paused) -> Result<void> {
      done.emplace_back(is_paused ? "pause" : "resume");
      return {};
    };
  }
  template <typename M>
  void Register(const std::string& name) {
    EXPECT_TRUE(modules.Add({name, "", "test", [](const Placement& placement) {
                               return std::unique_ptr<FrameworkElement>(std::make_unique<M>(placement));
                             }}));
  }
  static ChangeRequest Changes(const std::string& text) {
    Diagnostics diagnostics;
    ChangeRequest request{ParseChanges(text, {}, diagnostics)};
    EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
    return request;
  }
  void PressAndRelease() {
    runtime.robot_stop().Press("a test");
    EXPECT_TRUE(runtime.robot_stop().Release("a test"));
  }
  /// What becomes of a request that waits for the worker while `meanwhile` happens.
  CommandAnswer AskOver(const CommandRequest& request, const std::function<void()>& meanwhile,
                        RobotStop::AsOf as_of = {}) {
    std::binary_semaphore may_go(0);
    std::binary_semaphore is_over(0);
    TaskGroup tasks(service().worker());
    tasks.Post([&] { may_go.acquire(); });
    const auto pending = service().Begin(
        request, tasks, [&] { is_over.release(); }, as_of);
    meanwhile();
    may_go.release();
    is_over.acquire();
    return pending->Take();
  }
  CommandAnswer Ask(const CommandRequest& request) {
    return AskOver(request, [] {});
  }
  CommandService& service() {
    if (!service_) service_.emplace(application);
    return *service_;
  }
  bool Has(const std::string& path) {
    const std::lock_guard lock(runtime.structure_mutex());
    return runtime.root().Find(path).has_value();
  }
  static std::string ErrorOf(const CommandAnswer& answer) { return answer.diagnostics.ToString(); }

  Runtime runtime;
  ModuleRegistry modules;
  StructureEditor editor{runtime, modules, nullptr};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  ServedApplication application{runtime, modules, editor, log, {}, &history};
  std::vector<std::string> done;  // what hooks have been called for
  std::optional<CommandService> service_;
};

constexpr const char* kPressedSince = "STOP was pressed or released after this was asked for";

TEST_F(AskedBeforeStop, IsRefusedWhereSomethingMayMoveByIt) {
  ASSERT_TRUE(Ask(Changes("connect /a/speed /b/wheels")));
  ASSERT_TRUE(Ask(PublishRequest{"/b/input/wheels", "0.1"}));
  const auto at_hand = [&] {  // something to undo, and something to redo
    ASSERT_TRUE(Ask(Changes("create group /undone")));
    ASSERT_TRUE(Ask(Changes("create /redone test/base")));
    ASSERT_TRUE(Ask(UndoRequest{}));
    done.clear();
  };
  const std::vector<CommandRequest> all{Changes("connect /b/speed /a/wheels"),
                                        Changes("disconnect /a/speed /b/wheels"),
                                        Changes("create /new test/base"),
                                        Changes("create group /new; create /new/base test/base"),
                                        Changes("replace /a with test/base"),
                                        Changes("copy /a"),
                                        Changes("rename /a aa"),
                                        Changes("delete /a"),
                                        UndoRequest{},
                                        RedoRequest{},
                                        ReloadRequest{"planning"},
                                        RestartRequest{},
                                        RestartRequest{"/a"},
                                        PauseRequest{"/a", false},
                                        PublishRequest{"/a/input/wheels", "0.1"},
                                        ReleaseRequest{"/b/input/wheels"}};
  constexpr std::size_t kOfWholeApplication =
      5;  // copy, rename, delete: refused while it runs, whenever they are asked for
  for (std::size_t i = 0; i < all.size(); ++i) {
    SCOPED_TRACE("request " + std::to_string(i));
    EXPECT_TRUE(LetsMove(all[i]));
    at_hand();
    const auto revision = runtime.revision();
    const CommandAnswer late = AskOver(all[i], [this] { PressAndRelease(); });
    EXPECT_EQ(late.outcome, Outcome::kRefused);
    EXPECT_THAT(ErrorOf(late), HasSubstr(kPressedSince));
    const CommandAnswer under_it = AskOver(all[i], [this] { runtime.robot_stop().Press("a test"); });
    EXPECT_THAT(ErrorOf(under_it), HasSubstr(kPressedSince));
    EXPECT_TRUE(runtime.robot_stop().Release("a test"));
    EXPECT_EQ(runtime.revision(), revision) << "nothing of it is done";
    EXPECT_THAT(done, IsEmpty());
    EXPECT_EQ(history.NextUndo(), "create group /undone");
    EXPECT_EQ(history.NextRedo(), "create /redone test/base");
    if (i < kOfWholeApplication || i >= kOfWholeApplication + 3) {
      const CommandAnswer again = Ask(all[i]);
      EXPECT_TRUE(again) << "asked for now: " << ErrorOf(again);
    }
    while (history.NextUndo() && Has("/undone")) ASSERT_TRUE(Ask(UndoRequest{}));
  }
}

TEST_F(AskedBeforeStop, IsDoneWhereNothingCanMoveByIt) {
  const std::vector<CommandRequest> all{SaveRequest{"file"}, QuitRequest{}, PauseRequest{"/a", true},
                                        *MakeRequest("log", {{"level", "debug"}}, "a test"),
                                        Changes("log /a debug; tag /a seen; create group /new")};
  for (const CommandRequest& each : all) {
    EXPECT_FALSE(LetsMove(each));
    const CommandAnswer answer = AskOver(each, [this] { PressAndRelease(); });
    EXPECT_TRUE(answer) << ErrorOf(answer);
  }
  EXPECT_THAT(done, ElementsAre("file", "quit", "pause"));
  EXPECT_TRUE(Has("/new"));
  EXPECT_FALSE(LetsMove(BlockRequest{"/a/input/wheels"}));
  EXPECT_FALSE(LetsMove(RobotStopRequest{true}));
  EXPECT_TRUE(LetsMove(RobotStopRequest{false}));
}

TEST_F(AskedBeforeStop, WhoKnowsOfTheStopIsServedUnderIt) {
  runtime.robot_stop().Press("a test");
  EXPECT_TRUE(Ask(Changes("connect /b/speed /a/wheels")));
  EXPECT_TRUE(Ask(UndoRequest{}));
  EXPECT_TRUE(Ask(ReloadRequest{"planning"}));
  EXPECT_THAT(done, ElementsAre("planning"));
}

TEST_F(AskedBeforeStop, WhoSaysWhenHeAskedIsBelieved) {
  const Time before = SteadyClock().Now();
  PressAndRelease();
  const auto nothing = [] {};
  EXPECT_THAT(ErrorOf(AskOver(Changes("create /new test/base"), nothing, {.asked = before, .requests = {}})),
              HasSubstr(kPressedSince));
  EXPECT_THAT(ErrorOf(AskOver(UndoRequest{}, nothing, {.asked = {}, .requests = 1})), HasSubstr(kPressedSince));
  EXPECT_TRUE(AskOver(SaveRequest{"file"}, nothing, {.asked = before, .requests = 1}));
  EXPECT_TRUE(AskOver(Changes("create /new test/base"), nothing, {.asked = SteadyClock().Now(), .requests = 2}));
}

TEST_F(AskedBeforeStop, WhatIsBeingMadeWhenItIsPressedIsNotPutIn) {
  const auto make = [&](const CommandRequest& request) {
    std::binary_semaphore is_over(0);
    TaskGroup tasks(service().worker());
    const auto pending = service().Begin(request, tasks, [&] { is_over.release(); });
    being_made.acquire();
    PressAndRelease();
    may_be_made.release();
    is_over.acquire();
    return pending->Take();
  };
  const auto let_it_be_made = [&](const CommandRequest& request) {
    may_be_made.release();
    const CommandAnswer answer = Ask(request);
    being_made.acquire();
    return answer;
  };
  const ChangeRequest create = Changes("connect /b/speed /a/wheels; create /slow test/slow");
  const auto revision = runtime.revision();
  EXPECT_THAT(ErrorOf(make(create)), HasSubstr(kPressedSince));
  EXPECT_FALSE(Has("/slow"));
  EXPECT_EQ(runtime.revision(), revision);
  EXPECT_THAT(ErrorOf(make(Changes("replace /b with test/slow"))), HasSubstr(kPressedSince));
  ASSERT_TRUE(let_it_be_made(create));
  ASSERT_TRUE(Ask(Changes("delete /slow")));
  EXPECT_THAT(ErrorOf(make(UndoRequest{})), HasSubstr(kPressedSince));
  EXPECT_FALSE(Has("/slow"));
  EXPECT_EQ(history.NextUndo(), "delete /slow") << "it is not forgotten";
  EXPECT_TRUE(let_it_be_made(UndoRequest{}));
  EXPECT_TRUE(Has("/slow"));
}

}  // namespace
}  // namespace runnel::test
