// A component of GenoM3 in an application: its activities from the terminal, interrupted, resumed, swapped, recorded.

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/integration/recorded_values.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GenomDemo : public testing::Test {
 protected:
  GenomDemo() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~GenomDemo() override { unsetenv("XDG_RUNTIME_DIR"); }

  /// Until the application answers.
  static std::string Trip() {
    Ended asked;
    for (int tries = 0; tries < 600 && asked.code != kDone; ++tries) asked = Runnel("call /guide/get_trip");
    return asked.text;
  }
  /// The parameter follows the attribute in one of the next cycles.
  static std::string Limits(const std::string& awaited) {
    std::string text;
    for (int tries = 0; tries < 600 && text.find(awaited) == std::string::npos; ++tries)
      text = Runnel("get /guide/parameter/set_limits").text;
    return text;
  }

  TemporaryFolder folder_;
  const std::string demo_ = std::string(RUNNEL_XML) + "/apps/genom_demo.xml";
};

TEST_F(GenomDemo, IsSentInterruptedResumedAndSwapped) {
  const std::string recording = folder_ / "trip.mcap";
  Program program("run " + demo_ + " --speed 10 --statistics --record " + recording);
  EXPECT_THAT(Trip(), HasSubstr("is_set: false"));
  const Ended refused = Runnel("call /guide/set_limits '{limits: {speed: 3, turn_rate: 1}}'");
  EXPECT_EQ(refused.code, kRunFailed);
  EXPECT_THAT(refused.text, HasSubstr("guide::too_far {limit: 1}"));
  const Ended unset = Runnel("set /guide/set_limits '{speed: 3, turn_rate: 1}'");
  EXPECT_NE(unset.code, kDone);
  EXPECT_THAT(unset.text, HasSubstr("refuses the value: guide::too_far {limit: 1}"));
  EXPECT_EQ(Runnel("set /guide/set_limits '{speed: 0.3, turn_rate: 1.2}'").code, kDone);
  EXPECT_THAT(Runnel("get /guide/output/genom_state").text, HasSubstr("component: \"guide\""));
  EXPECT_EQ(Runnel("call /guide/set_limits '{limits: {speed: 0.35, turn_rate: 1.2}}'").code, kDone);
  EXPECT_THAT(Limits("{speed: 0.35, turn_rate: 1.2}"), HasSubstr("{speed: 0.35, turn_rate: 1.2}"));
  EXPECT_EQ(Runnel("call /guide/set_limits").code, kDone) << "all arguments have defaults";
  EXPECT_THAT(Limits("{speed: 0.4, turn_rate: 1.2}"), HasSubstr("{speed: 0.4, turn_rate: 1.2}"));
  EXPECT_THAT(Runnel("call /guide/resume").text, HasSubstr("guide::no_pose"));
  EXPECT_THAT(Runnel("call /guide/go_to '{to: {x: 500, y: 0}}'").text, HasSubstr("guide::too_far {limit: 100}"));

  Program going("call /guide/go_to '{to: {x: 5.6, y: 0.5}}' --timeout 1000s");
  ASSERT_TRUE(going.WaitFor("0 % "));
  EXPECT_THAT(Runnel("activities").text, HasSubstr("/guide/output/go_to: 0 % "));
  int aborted = kRunFailed;
  for (int tries = 0; tries < 100 && aborted != kDone; ++tries)
    aborted = Runnel("activities --abort /guide/go_to").code;
  EXPECT_EQ(aborted, kDone);
  EXPECT_EQ(going.Wait().code, kDone) << "its codel of `stop` has come to ether";
  EXPECT_THAT(Trip(), HasSubstr("to: {x: 5.6, y: 0.5}"));

  Program resuming("call /guide/resume --timeout 1000s");
  ASSERT_TRUE(resuming.WaitFor("0 % "));
  EXPECT_EQ(Runnel("swap /guide guide/guide").code, kDone);
  EXPECT_EQ(resuming.Wait().code, kDone) << "interrupted, its codel of `stop` has the last word";
  EXPECT_THAT(Trip(), AllOf(HasSubstr("is_set: true"), HasSubstr("to: {x: 5.6, y: 0.5}"))) << "the ids are kept";
  Program once_more("call /guide/resume --timeout 1000s");
  ASSERT_TRUE(once_more.WaitFor("0 % "));
  EXPECT_EQ(Runnel("reload guide").code, kDone);
  EXPECT_EQ(once_more.Wait().code, kDone);
  EXPECT_THAT(Trip(), HasSubstr("is_set: true"));
  const Ended arrived = Runnel("call /guide/go_to '{to: {x: -4.5, y: -0.5}}' --timeout 1000s");
  EXPECT_EQ(arrived.code, kDone) << arrived.text;
  EXPECT_EQ(Runnel("quit").code, kDone);
  (void)program.Wait();
  EXPECT_THAT(Runnel("info " + recording).text,
              AllOf(HasSubstr("/guide/output/go_to_calls"), HasSubstr("/guide/output/twist")));
  const Ended replayed = Runnel("replay " + recording + " " + demo_ +
                                " --ports localisation/pose --ports eyes/surroundings --rate 0 --quiet");
  EXPECT_EQ(replayed.code, kDone) << replayed.text;
}

// The calls of a recording are made again, in the cycles in which they were served.
TEST_F(GenomDemo, DoesTheSameInAReplayWithItsCalls) {
  const std::string recording = folder_ / "run.mcap";
  const std::string again = folder_ / "again.mcap";
  Program program("run " + demo_ + " --speed 10 --record " + recording);
  EXPECT_THAT(Trip(), HasSubstr("is_set: false"));
  Program going("call /guide/go_to '{to: {x: 5.6, y: 0.5}}' --timeout 1000s");
  ASSERT_TRUE(going.WaitFor("0 % "));
  EXPECT_EQ(Runnel("call /guide/set_limits '{limits: {speed: 0.3, turn_rate: 1}}'").code, kDone);
  int aborted = kRunFailed;
  for (int tries = 0; tries < 100 && aborted != kDone; ++tries)
    aborted = Runnel("activities --abort /guide/go_to").code;
  EXPECT_EQ(aborted, kDone);
  EXPECT_EQ(going.Wait().code, kDone);
  const Ended arrived = Runnel("call /guide/go_to '{to: {x: -4.5, y: -0.5}}' --timeout 1000s");
  EXPECT_EQ(arrived.code, kDone) << arrived.text;
  EXPECT_EQ(Runnel("quit").code, kDone);
  (void)program.Wait();
  const Ended replayed =
      Runnel("replay " + recording + " " + demo_ +
             " --ports localisation/pose --ports eyes/surroundings --rate 0 --quiet --record " + again);
  EXPECT_EQ(replayed.code, kDone) << replayed.text;
  EXPECT_THAT(replayed.text, HasSubstr(" calls"));
  for (const char* port : {"/genom_demo/guide/output/twist", "/genom_demo/guide/output/go_to_calls",
                           "/genom_demo/guide/output/set_limits_calls"}) {
    const auto recorded = ValuesOf(recording, port);
    EXPECT_FALSE(recorded.empty()) << port;
    EXPECT_EQ(ValuesOf(again, port), recorded) << port;
  }
}

}  // namespace
}  // namespace runnel::test
