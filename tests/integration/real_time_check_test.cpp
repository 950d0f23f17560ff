// What the program says of modules that do in their cycles what takes a time nobody can foresee.

#include <csignal>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "plugins/real_time_check/sanitizer.h"
#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kHooks = "librunnel_real_time_hooks.so";

class RealTimeCheck : public testing::Test {
 protected:
  void SetUp() override {
    if (RUNNEL_UNDER_SANITIZER) GTEST_SKIP() << "a sanitizer has its own malloc";
    std::ofstream(application_) << R"(<application name="hasty">
      <load plugin="faulty"/> <clock type="simulated"/> <thread name="main" period="10ms"/>
      <module name="calm" type="faulty/worker"/>
      <module name="hasty" type="faulty/worker"> <parameter name="allocates" value="true"/> </module>
    </application>)";
  }
  TemporaryFolder folder_;
  const std::string application_ = folder_ / "hasty.xml";
};

TEST_F(RealTimeCheck, NamesTheModuleThatAllocatesWithItsCalls) {
  const Ended ended = Runnel("run --fast --quiet --duration 1 --check-real-time=90 " + application_);
  EXPECT_EQ(ended.code, kRunFailed);
  EXPECT_THAT(ended.text, HasSubstr("error: /hasty/hasty: allocates in its cycle (malloc, 10 times):\n    "));
  EXPECT_THAT(ended.text, HasSubstr("\n    runnel::test::FaultyWorker::Update() at "));
  EXPECT_THAT(ended.text, Not(HasSubstr("/hasty/calm")));
}

TEST_F(RealTimeCheck, TheDemoKeepsRealTime) {
  const Ended ended = Runnel("run --fast --quiet --check-real-time " + kDemo + "picture=");
  EXPECT_EQ(ended.code, kDone);
  EXPECT_THAT(ended.text,
              AllOf(HasSubstr("reached"), HasSubstr("no module has allocated, locked or called the system")));
}

TEST_F(RealTimeCheck, WhoDoesNotAskHasNothingOfIt) {
  Program program("run --paused " + application_);
  ASSERT_TRUE(program.WaitFor("paused"));
  EXPECT_THAT(program.Maps(), Not(HasSubstr(kHooks)));
  program.Send(SIGTERM);
  (void)program.Wait();
  Program checked("run --paused --check-real-time " + application_);
  ASSERT_TRUE(checked.WaitFor("paused"));
  EXPECT_THAT(checked.Maps(), HasSubstr(kHooks));
  checked.Send(SIGTERM);
  (void)checked.Wait();
}

TEST_F(RealTimeCheck, NonsenseIsRefused) {
  const Ended ended = Runnel("run --check-real-time=soon " + application_);
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("--check-real-time: 'soon' is not a number of cycles"));
}

}  // namespace
}  // namespace runnel::test
