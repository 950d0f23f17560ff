// Services called from a terminal.

#include <atomic>
#include <thread>

#include "plugins/services/service.h"
#include "tests/plugins/control/control_fixture.h"

namespace runnel::test {
namespace {

class Clerk final : public Module {
 public:
  using Module::Module;
  Service<int(std::string, int)> write{this, "write", &Clerk::Write, {.arguments = {"file", "copies"}}};
  Service<double(double)> half{this, "half", &Clerk::Half};
  Service<void()> reset{this, "reset", &Clerk::Reset};
  Service<int(int)> sort{this, "sort", &Clerk::Sort, {.arguments = {"drawer"}}};

 private:
  Result<int> Write(const std::string& file, int copies) {
    if (file.empty()) return Error{.message = "a file has a name"};
    return static_cast<int>(file.size()) * copies;
  }
  double Half(double value) { return value / 2; }
  void Reset() {}
  static Result<int> Sort(Clerk&, Activity& activity, int drawer) {
    activity.Report(0.25, "sorting");
    while (drawer == 0 && !activity.is_abort_asked()) std::this_thread::yield();
    if (drawer == 0) return Error{.message = "left unsorted"};
    return drawer;
  }
  void Update() override {}
};

class CallCommandTest : public ControlTest {
 protected:
  CallCommandTest() {
    Register<Clerk>("test/clerk");
    EXPECT_EQ(Change("create /clerk test/clerk").code, 0);
  }
};

TEST_F(CallCommandTest, ShowsTheReply) {
  const Told told = Ask("call /clerk/write \"{file: map.pgm, copies: 3}\"");
  EXPECT_EQ(told.code, 0) << told.errors;
  EXPECT_EQ(told.output, "21\n");
  EXPECT_EQ(Ask("call /clerk/half 5").output, "2.5\n");
  EXPECT_EQ(Ask("call /app/clerk/output/reset").output, "done\n");
}

TEST_F(CallCommandTest, SaysWhatIsWrong) {
  EXPECT_THAT(Ask("call /clerk/write").errors, HasSubstr("of the shape '{file: \"\", copies: 0}'"));
  EXPECT_THAT(Ask("call /clerk/write \"{fil: x}\"").errors, HasSubstr("did you mean 'file'?"));
  EXPECT_THAT(Ask("call /clerk/half many").errors, HasSubstr("many"));
  EXPECT_THAT(Ask("call /clerk/reset 5").errors, HasSubstr("takes no arguments"));
  EXPECT_THAT(Ask("call /clerk/rest").errors, HasSubstr("did you mean 'reset'?"));
  const Told no_service = Ask("call /a/out");
  EXPECT_EQ(no_service.code, 2);
  EXPECT_THAT(no_service.errors, HasSubstr("is no service; services are /app/clerk/output/write"));
  EXPECT_THAT(Ask("call /clerk/reset timeout=soon").errors, HasSubstr("soon"));
}

TEST_F(CallCommandTest, SaysWhatTheServiceSays) {
  const Told told = Ask("call /clerk/write \"{copies: 3}\"");
  EXPECT_EQ(told.code, 1);
  EXPECT_THAT(told.errors, HasSubstr("/clerk/write: the call has failed: a file has a name"));
}

TEST_F(CallCommandTest, TimesOutWhenNobodyServes) {
  ASSERT_TRUE(scheduler.SetPaused("/app/clerk", true));
  const Told told = Ask("call /clerk/reset timeout=20ms");
  EXPECT_EQ(told.code, 1);
  EXPECT_THAT(told.errors, HasSubstr("timed out"));
}

TEST_F(CallCommandTest, ListsActivitiesAndAbortsThem) {
  EXPECT_THAT(Ask("activities").output,
              ::testing::AllOf(HasSubstr("/app/clerk/output/sort: 0 waiting"), ::testing::Not(HasSubstr("write"))));
  EXPECT_THAT(Ask("activities all=yes").output, HasSubstr("write: 0 waiting"));
  EXPECT_THAT(Ask("activities /clerk/sort abort=yes").errors, HasSubstr("no call is under way"));
  Told told;
  std::thread caller([&] { told = Ask("call /clerk/sort \"{}\""); });
  while (Ask("activities").output.find("25 % sorting") == std::string::npos) {
  }
  EXPECT_EQ(Ask("activities /clerk/sort abort=yes").code, 0);
  caller.join();
  EXPECT_EQ(told.code, 1);
  EXPECT_THAT(told.errors, ::testing::AllOf(HasSubstr("25 % sorting"), HasSubstr("left unsorted")));
  EXPECT_EQ(Ask("call /clerk/sort \"{drawer: 7}\"").output, "7\n");
}

TEST_F(CallCommandTest, WhoHangsUpGivesTheCallUp) {
  const int client = RawClient();
  SendAll(client, "request 19\ncall /clerk/sort {}\n");
  while (Ask("activities").output.find("25 % sorting") == std::string::npos) {
  }
  close(client);
  while (Ask("activities").output.find("1 failed") == std::string::npos) {
  }
}

}  // namespace
}  // namespace runnel::test
