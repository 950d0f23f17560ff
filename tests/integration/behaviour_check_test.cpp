// What `runnel check` finds in networks of behaviours: by thinking, and by a model checker.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "plugins/application/application_description.h"
#include "plugins/behaviours/network.h"
#include "plugins/behaviours/promela.h"

namespace runnel::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string DemoAsItIs() {
  std::ostringstream text;
  text << std::ifstream(RUNNEL_XML "/apps/behaviour_demo.xml").rdbuf();
  return text.str();
}

// Without its properties, which take Spin some seconds.
std::string Demo() {
  std::istringstream lines(DemoAsItIs());
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("<never") == std::string::npos && line.find("<eventually") == std::string::npos) text += line + "\n";
  }
  return text;
}

std::string With(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// The demonstration with a word more in its network.
std::string DemoWith(const std::string& word) {
  return With(Demo(), "<module name=\"teller\"", word + "\n    <module name=\"teller\"");
}

std::vector<std::string> Messages(const std::vector<Error>& errors) {
  std::vector<std::string> messages;
  for (const Error& each : errors) messages.push_back(each.path + ": " + each.message);
  return messages;
}

/// Each with the line that it is about.
std::vector<std::string> FlawsOf(const std::string& text) {
  ApplicationDescription description;
  description.ReadText(text, RUNNEL_XML "/apps", "test.xml");
  description.RunChecks();
  EXPECT_THAT(Messages(description.diagnostics().warnings()), IsEmpty());
  for (const Error& each : description.diagnostics().errors()) {
    std::istringstream lines(text);
    std::string line;
    for (int i = 0; i < each.position.line; ++i) std::getline(lines, line);
    const std::string attribute = " name=\"";
    const auto name = line.find(attribute);
    if (name != std::string::npos) {  // else a property
      const auto begin = name + attribute.size();
      const std::string named = line.substr(begin, line.find('"', begin) - begin);
      EXPECT_THAT(each.path + "/", HasSubstr("/" + named + "/")) << "is in line " << line;
    }
    EXPECT_NE(each.position.line, 0) << each.ToString();
  }
  return Messages(description.diagnostics().errors());
}

bool HasSpin() { return std::system("spin -V > /dev/null 2>&1") == 0; }

TEST(NetworkCheckTest, TheDemonstrationIsSound) { EXPECT_THAT(FlawsOf(Demo()), IsEmpty()); }

TEST(NetworkCheckTest, FindsBehavioursThatCanNeverBeActive) {
  const std::string nobody = With(Demo(), "<connect from=\"drive/activity\" to=\"avoid/stimulation\"/>", "");
  EXPECT_THAT(FlawsOf(nobody),
              ElementsAre("/behaviour_demo/network/avoid: can never be active: nothing stimulates it"));
  const std::string nobody_who_could =
      With(nobody, "to=\"drive/inhibition1 follow_wall/stimulation\"",
           "to=\"drive/inhibition1\"/><connect from=\"avoid/activity\" to=\"follow_wall/stimulation\"");
  EXPECT_THAT(FlawsOf(nobody_who_could),
              ::testing::Contains("/behaviour_demo/network/follow_wall: can never be active: only network/avoid would "
                                  "stimulate it, which can never be active"));
  const std::string itself = With(Demo(), "to=\"avoid/stimulation\"", "to=\"avoid/stimulation avoid/inhibition1\"");
  EXPECT_THAT(FlawsOf(itself),
              ElementsAre(AllOf(HasSubstr("network/avoid: can never be fully active"),
                                HasSubstr("network/drive, without which it is not active, inhibits it"))));
}

TEST(NetworkCheckTest, FindsLoopsThatCanOscillate) {
  const std::string loop =
      With(Demo(), "to=\"avoid/stimulation\"/>",
           "to=\"avoid/stimulation\"/><connect from=\"motion/activity\" to=\"escape/stimulation\"/>"
           "<connect from=\"avoid/activity\" to=\"drive/inhibition1\" late=\"true\"/>");
  const std::string without_others = With(loop, "drive/inhibition1 follow_wall/stimulation", "follow_wall/stimulation");
  EXPECT_THAT(
      FlawsOf(without_others),
      ::testing::Contains(AllOf(HasSubstr("can oscillate"), HasSubstr("network/avoid inhibits network/drive, which "
                                                                      "activates network/avoid"))));
  const std::string even = With(Demo(), "to=\"avoid/stimulation\"/>",
                                "to=\"avoid/stimulation\"/>"
                                "<connect from=\"drive/activity\" to=\"escape/inhibition1\" late=\"true\"/>");
  EXPECT_THAT(FlawsOf(even), Not(::testing::Contains(HasSubstr("can oscillate")))) << "each holds the other down";
  const std::string both_late = With(even, "to=\"drive/inhibition1 follow_wall/stimulation\"/>",
                                     "to=\"follow_wall/stimulation\"/>"
                                     "<connect from=\"escape/activity\" to=\"drive/inhibition1\" late=\"true\"/>");
  EXPECT_THAT(FlawsOf(both_late), Not(::testing::Contains(HasSubstr("can oscillate"))))
      << "one of the two runs behind the other";
  const std::string apart = With(With(even, "<module name=\"escape\"", "<module name=\"escape\" thread=\"other\""),
                                 "<thread ", "<thread name=\"other\" period=\"50ms\"/> <thread ");
  EXPECT_THAT(FlawsOf(apart), ::testing::Contains(AllOf(HasSubstr("can oscillate, for all go on and off together"),
                                                        HasSubstr("; 2 of these can come a cycle late"))))
      << "two threads";
}

TEST(NetworkCheckTest, FindsTwoOnOneActuatorWithoutFusion) {
  const std::string both =
      With(Demo(), "<connect from=\"safe_motion/out\" to=\"twist\"/>",
           "<connect from=\"safe_motion/out\" to=\"twist\"/><connect from=\"avoid/twist\" to=\"twist\"/>");
  EXPECT_THAT(FlawsOf(both),
              ElementsAre("/behaviour_demo/gate/input/wanted: network/safe_motion and network/avoid command "
                          "it, and can be active at once without a fusion"));
  const std::string by_turns =
      With(Demo(), "<connect from=\"safe_motion/out\" to=\"twist\"/>",
           "<connect from=\"drive/twist\" to=\"twist\"/><connect from=\"follow_wall/twist\" to=\"twist\"/>");
  EXPECT_THAT(FlawsOf(by_turns), IsEmpty()) << "what stimulates the one inhibits the other";
}

TEST(NetworkCheckTest, WritesTheModel) {
  ApplicationDescription description;
  ASSERT_TRUE(description.ReadText(Demo(), RUNNEL_XML "/apps", "test.xml"));
  const std::string text = PromelaText(ReadNetwork(*description.element()), nullptr);
  EXPECT_THAT(text, HasSubstr("/* network/drive */"));
  EXPECT_THAT(text, HasSubstr("active_1 = true && (!active_0) && true && wants_1;"));
}

TEST(NetworkCheckTest, TheProgramWritesTheModelAndEndsWithAnErrorIfThereIsAFlaw) {
  const std::filesystem::path folder = ::testing::TempDir() + "runnel_network_check_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "network.xml").string(), model = (folder / "network.pml").string();
  const auto check = [&](std::string text) {
    for (auto at = text.find("../worlds"); at != std::string::npos; at = text.find("../worlds")) {
      text.replace(at, 2, RUNNEL_XML);
    }
    std::ofstream(file) << text;
    return std::system((RUNNEL_PROGRAM " check " + file + " --model " + model + " > /dev/null 2>&1").c_str());
  };
  EXPECT_EQ(check(Demo()), 0);
  std::ostringstream written;
  written << std::ifstream(model).rdbuf();
  EXPECT_THAT(written.str(), HasSubstr("active proctype cycles()"));
  EXPECT_NE(check(With(Demo(), "<connect from=\"drive/activity\" to=\"avoid/stimulation\"/>", "")), 0);
  std::filesystem::remove_all(folder);
}

TEST(NetworkPropertyTest, HoldInTheDemonstration) {
  if (!HasSpin()) GTEST_SKIP() << "the package spin is not here";
  EXPECT_THAT(DemoAsItIs(), AllOf(HasSubstr("<never active=\"drive follow_wall\"/>"),
                                  HasSubstr("<eventually active=\"drive\" after=\"escape\"/>")));
  EXPECT_THAT(FlawsOf(DemoAsItIs()), IsEmpty());
}

// What comes a cycle late, or from another thread at any time, leaves room for both.
TEST(NetworkPropertyTest, DoesNotHoldWhereAnInhibitionComesLate) {
  if (!HasSpin()) GTEST_SKIP() << "the package spin is not here";
  const std::string never = DemoWith("<never active=\"drive follow_wall\"/>");
  const std::string late = With(
      never, "to=\"drive/inhibition1 follow_wall/stimulation\"/>",
      "to=\"follow_wall/stimulation\"/><connect from=\"escape/activity\" to=\"drive/inhibition1\" late=\"true\"/>");
  EXPECT_THAT(FlawsOf(late), ElementsAre(HasSubstr("<never> can be: ")));
  const std::string apart = With(With(never, "<module name=\"escape\"", "<module name=\"escape\" thread=\"other\""),
                                 "<thread ", "<thread name=\"other\" period=\"50ms\"/> <thread ");
  EXPECT_THAT(FlawsOf(apart), ElementsAre(HasSubstr("<never> can be: ")));
}

// Somebody has forgotten a connection: the model checker tells what comes of it.
TEST(NetworkPropertyTest, ASeededFaultIsToldAsTheBehavioursThatFollowEachOther) {
  if (!HasSpin()) GTEST_SKIP() << "the package spin is not here";
  const std::string forgotten =
      With(DemoWith("<never active=\"drive follow_wall\"/>"), "to=\"drive/inhibition1 follow_wall/stimulation\"",
           "to=\"follow_wall/stimulation\"");
  EXPECT_THAT(FlawsOf(forgotten), ElementsAre("/behaviour_demo: <never> can be: network/drive, network/escape, "
                                              "network/follow_wall, network/motion, network/safe_motion"));
  const std::string for_ever =
      With(DemoWith("<eventually active=\"drive\" after=\"escape\"/>"),
           "<connect from=\"drive/activity\" to=\"avoid/stimulation\"/>",
           "<connect from=\"drive/activity\" to=\"avoid/stimulation\"/>"
           "<connect from=\"emergency_stop/activity\" to=\"drive/inhibition2\" late=\"true\"/>");
  const std::string two = With(for_ever, "<module name=\"drive\" type=\"behaviours/drive_to_goal\">",
                               "<module name=\"drive\" type=\"behaviours/drive_to_goal\">"
                               "<parameter name=\"inhibitions\" value=\"2\"/>");
  EXPECT_THAT(FlawsOf(two), ElementsAre(AllOf(HasSubstr("<eventually> need not be: "), HasSubstr("over and over: "),
                                              HasSubstr("network/emergency_stop"), Not(HasSubstr("network/drive")))));
}

TEST(NetworkPropertyTest, NamesBehavioursOnly) {
  EXPECT_THAT(FlawsOf(DemoWith("<never active=\"drive teller\"/>")),
              ElementsAre(HasSubstr("/behaviour_demo/network/teller is no behaviour")));
  EXPECT_THAT(FlawsOf(DemoWith("<never active=\"drvie\"/>")), ElementsAre(HasSubstr("there is no 'drvie'")));
}

std::string Group(const std::string& contents) {
  return DemoWith("<group name=\"careful\" characteristic=\"both\">" + contents + "</group>");
}

TEST(BehaviourGroupFileTest, SaysWhatTheCharacteristicBehaviourLacks) {
  const std::string module =
      "<module name=\"both\" type=\"behaviours/follow_wall\">"
      "<parameter name=\"stimulation_mode\" value=\"enabled\"/></module>";
  EXPECT_THAT(FlawsOf(Group("")), ElementsAre(HasSubstr("its characteristic behaviour 'both' is not there")));
  EXPECT_THAT(FlawsOf(Group(module)), ::testing::Contains(HasSubstr("has no interface port 'stimulation'")));
  const std::string ports =
      "<port name=\"surroundings\" direction=\"input\"/><port name=\"stimulation\" direction=\"input\"/>"
      "<port name=\"inhibition1\" direction=\"input\"/><port name=\"activity\" direction=\"output\"/>"
      "<port name=\"target_rating\" direction=\"output\" type=\"TargetRating\"/>"
      "<connect from=\"surroundings\" to=\"both/surroundings\"/><connect from=\"stimulation\" to=\"both/stimulation\"/>"
      "<connect from=\"inhibition1\" to=\"both/inhibition1\"/><connect from=\"both/activity\" to=\"activity\"/>";
  const std::string fed = "</group><connect from=\"surroundings\" to=\"careful/surroundings\"/><group name=\"empty\">";
  EXPECT_THAT(FlawsOf(Group(module + ports + fed)), ElementsAre(HasSubstr("which speaks for the group")));
  EXPECT_THAT(FlawsOf(Group(module + ports + "<connect from=\"both/target_rating\" to=\"target_rating\"/>" + fed)),
              IsEmpty());
}

}  // namespace
}  // namespace runnel::test
