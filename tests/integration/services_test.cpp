// Services of an application file, from the terminal: called, recorded, swapped; wrong connections.

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ServicesOfAnApplication : public testing::Test {
 protected:
  ServicesOfAnApplication() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~ServicesOfAnApplication() override { unsetenv("XDG_RUNTIME_DIR"); }

  TemporaryFolder folder_;
  const std::string demo_ = std::string(RUNNEL_XML) + "/apps/places_demo.xml";
};

TEST_F(ServicesOfAnApplication, AreCalledFromTheTerminalSwappedAndRecorded) {
  const std::string recording = folder_ / "calls.mcap";
  Program program("run " + demo_ + " --speed 20 --statistics --record " + recording);
  // The position is there as soon as the call is answered: the book's connection comes first in its cycle.
  std::string text;
  for (int tries = 0; tries < 600 && text.find("x: ") == std::string::npos; ++tries) {
    text = Runnel("call /book/remember '{name: start}'").text;
  }
  EXPECT_THAT(text, HasSubstr("{x: "));
  EXPECT_THAT(Runnel("call /book/names").text, HasSubstr("\"start\""));
  const Ended gone = Runnel("call /driver/go '{name: start}'");
  EXPECT_EQ(gone.code, kDone) << gone.text;
  const Ended nowhere = Runnel("call /driver/go '{name: strt}'");
  EXPECT_EQ(nowhere.code, kRunFailed);
  EXPECT_THAT(nowhere.text, HasSubstr("did you mean 'start'?"));
  EXPECT_EQ(Runnel("swap /book places/book").code, kDone);
  EXPECT_THAT(Runnel("call /book/names").text, HasSubstr("\"start\""));
  EXPECT_THAT(Runnel("activities").text, HasSubstr("/places_demo/driver/output/go: 0 waiting, 1 answered, 1 failed"));
  EXPECT_THAT(Runnel("complete call /book/n").text, HasSubstr("/book/names"));
  EXPECT_EQ(Runnel("complete call /driver/go \"\"").text, "'{name: \"\"}'\n");
  EXPECT_EQ(Runnel("quit").code, kDone);
  (void)program.Wait();
  EXPECT_THAT(Runnel("info " + recording).text,
              AllOf(HasSubstr("/book/output/remember_calls"), HasSubstr("/driver/output/go_calls")));
}

// Who owns it, who writes in the application, and who writes from a terminal.
TEST_F(ServicesOfAnApplication, ABlackboardIsChangedByModulesAndFromTheTerminal) {
  const std::string recording = folder_ / "places.mcap";
  Program program("run " + demo_ + " --speed 20 --statistics --record " + recording);
  std::string text;
  for (int tries = 0; tries < 600 && text.find("way 1") == std::string::npos; ++tries) {
    text = Runnel("call /book/names").text;
  }
  EXPECT_THAT(text, HasSubstr("\"way 1\"")) << "noted by the surveyor";
  const Ended noted = Runnel("call /book/places_changes '{change: {name: door, pose: {x: 1, y: 2, heading: 0}}}'");
  EXPECT_THAT(noted.text, HasSubstr("is_applied: true"));
  const Ended late = Runnel("call /book/places_changes '{revision: 1, change: {name: late}}'");
  EXPECT_THAT(late.text, HasSubstr("is_applied: false"));
  const Ended wrong = Runnel("call /book/places_changes '{change: {name: \"\"}}'");
  EXPECT_THAT(wrong.text, HasSubstr("a place needs a name"));
  EXPECT_EQ(Runnel("swap /book places/book").code, kDone);
  EXPECT_THAT(Runnel("call /book/where '{name: door}'").text, HasSubstr("x: 1, y: 2"));
  EXPECT_THAT(Runnel("call /book/names").text, AllOf(HasSubstr("door"), Not(HasSubstr("late"))));
  EXPECT_EQ(Runnel("quit").code, kDone);
  (void)program.Wait();
  EXPECT_THAT(Runnel("info " + recording).text, HasSubstr("/book/output/places_changes_calls")) << "the changes";
}

TEST_F(ServicesOfAnApplication, AWrongPairIsToldByTheCheck) {
  std::ifstream stream(demo_);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string right = "from=\"book/where\"";
  text.replace(text.find(right), right.size(), "from=\"book/names\"");
  const std::string wrong = folder_ / "wrong.xml";
  std::ofstream(wrong) << text;
  const Ended checked = Runnel("check " + wrong + " world=" RUNNEL_XML "/worlds/rooms.xml");
  EXPECT_EQ(checked.code, kBadInput);
  EXPECT_THAT(checked.text,
              AllOf(HasSubstr("service string[]()"), HasSubstr("service Pose2(string)"), HasSubstr("wrong.xml:")));
}

}  // namespace
}  // namespace runnel::test
