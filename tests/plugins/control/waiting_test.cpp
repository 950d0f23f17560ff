// That answers are sent when they are there, and not when a clock says to look: counted, not timed.
#include <semaphore>
#include <string>

#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "plugins/control/command.h"
#include "plugins/structure/change_history.h"

namespace runnel::test {
namespace {

class Collected final : public Answer {
 public:
  void Write(std::string_view text) override { output += text; }
  void WriteError(std::string_view text) override { errors += text; }
  std::string output;
  std::string errors;
};

TEST(WaitingCommand, IsDueWhenTheWorkerIsDoneAndNotBefore) {
  Runtime runtime;
  ModuleRegistry modules;
  StructureEditor editor(runtime, modules, nullptr);
  ChangeHistory history(editor);
  ApplicationLog log(runtime.clock());
  ServiceHooks hooks;
  hooks.save = [](const std::string&) -> Result<std::string> { return std::string("saved"); };
  hooks.reload = hooks.save;
  CommandService service({runtime, modules, editor, log, hooks, &history});
  std::binary_semaphore may_go(0);
  std::counting_semaphore<> done(0);
  TaskGroup tasks(service.worker(), [&] { done.release(); });
  for (const char* request : {"save", "reload planning", "change\ncreate group /g", "undo", "redo"}) {
    tasks.Post([&] { may_go.acquire(); });
    auto command = MakeCommand(request, service, tasks);
    ASSERT_TRUE(command) << request;
    Collected collected;
    EXPECT_FALSE(command->Continue(collected)) << request;
    EXPECT_EQ(command->due(), Command::SteadyTime::max()) << request << " is polled";
    may_go.release();
    done.acquire();  // of the one that has kept the worker busy
    done.acquire();
    EXPECT_EQ(command->due(), Command::SteadyTime::min()) << request << " is not sent at once";
    EXPECT_EQ(command->Continue(collected), ControlCode::kDone) << request << collected.errors;
    EXPECT_FALSE(collected.output.empty()) << request;
  }
}

}  // namespace
}  // namespace runnel::test
