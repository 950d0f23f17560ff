#include "plugins/inspector/panel_file.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPanel =
    R"({"panel": 1, "widgets": [{"id": "a", "kind": "joystick", "x": 0, "y": 0, "w": 4, "h": 6, "target": "/drive/twist"}]})";

std::string Problem(const std::string& text) {
  const auto good = CheckPanel(text);
  return good ? "" : good.error().message + "; " + good.error().hint;
}

std::string Widget(const std::string& members) { return R"({"panel": 1, "widgets": [{)" + members + "}]}"; }

TEST(CheckPanel, SaysWhatIsWrong) {
  EXPECT_EQ(Problem(kPanel), "");
  EXPECT_EQ(Problem(R"({"panel": 1, "widgets": []})"), "");
  EXPECT_THAT(Problem(""), HasSubstr("cannot be read"));
  EXPECT_THAT(Problem("[]"), HasSubstr("is no JSON object"));
  EXPECT_THAT(Problem(R"({"panel": 1})"), HasSubstr("\"widgets\" is missing"));
  EXPECT_THAT(Problem(R"({"panel": 2, "widgets": []})"), HasSubstr("version 2"));
  EXPECT_THAT(Problem(R"({"panel": 1, "widgets": [], "more": 1})"), HasSubstr("more"));
  EXPECT_THAT(Problem(std::string(300'000, ' ')), HasSubstr("256 kB"));
  EXPECT_THAT(Problem(Widget(R"("id": "a", "kind": "joystik", "x": 0, "y": 0, "w": 1, "h": 1)")),
              HasSubstr("widget 1 of the panel: there is no kind 'joystik'; did you mean 'joystick'?"));
  EXPECT_THAT(Problem(Widget(R"("id": "a", "kind": "map", "x": 9, "y": 0, "w": 4, "h": 1)")),
              HasSubstr("beside the grid"));
  EXPECT_THAT(Problem(Widget(R"("id": "a", "kind": "map", "x": 0, "y": 0, "w": 0, "h": 1)")),
              HasSubstr("beside the grid"));
  EXPECT_THAT(Problem(Widget(R"("id": "a", "kind": "map", "x": 0, "y": 0, "w": 1, "h": 1, "sound": 1)")),
              HasSubstr("sound"));
  EXPECT_THAT(Problem(R"({"panel": 1, "widgets": [
    {"id": "a", "kind": "map", "x": 0, "y": 0, "w": 1, "h": 1},
    {"id": "a", "kind": "map", "x": 1, "y": 0, "w": 1, "h": 1}]})"),
              HasSubstr("there are two 'a'"));
}

TEST(CheckPanel, RefusesASettingOfAWrongKind) {
  const auto with = [](const std::string& setting) {
    return Problem(Widget(R"("id": "a", "kind": "plot", "x": 0, "y": 0, "w": 1, "h": 1, )" + setting));
  };
  for (const char* good : {R"("minimum": -1.5)", R"("title": "x", "held": false)", R"("step": null)", R"("curves": [])",
                           R"("curves": [{"target": "/a"}, {"target": "/b", "field": "x"}])"}) {
    EXPECT_EQ(with(good), "") << good;
  }
  EXPECT_THAT(with(R"("minimum": "0")"), HasSubstr("\"minimum\" must be a number"));
  EXPECT_THAT(with(R"("maximum": 1e999)"), HasSubstr("must be a number"));
  EXPECT_THAT(with(R"("title": 7)"), HasSubstr("\"title\" must be a text"));
  EXPECT_THAT(with(R"("held": "yes")"), HasSubstr("\"held\" must be true or false"));
  for (const char* wrong :
       {R"("x")", R"([7])", R"([{"field": "x"}])", R"([{"target": 7}])", R"([{"target": "/a", "more": 1}])"}) {
    EXPECT_THAT(with(R"("curves": )" + std::string(wrong)), HasSubstr("\"curves\" must be a list")) << wrong;
  }
}

TEST(PanelFile, IsBesideTheApplicationsFile) {
  const TemporaryFolder folder;
  PanelFile panel((folder.path() / "robot.xml").string());
  EXPECT_EQ(panel.file(), folder.path() / "robot.panel.json");
  EXPECT_EQ(*panel.Read(), "") << "there is none";
  const auto done = panel.Save(kPanel);
  ASSERT_TRUE(done) << done.error().ToString();
  EXPECT_THAT(*done, HasSubstr("robot.panel.json"));
  EXPECT_EQ(*PanelFile((folder.path() / "robot.xml").string()).Read(), kPanel);
}

TEST(PanelFile, ARefusedPanelLeavesTheOldOne) {
  const TemporaryFolder folder;
  PanelFile panel((folder.path() / "robot.xml").string());
  ASSERT_TRUE(panel.Save(kPanel));
  EXPECT_FALSE(panel.Save(R"({"panel": 1, "widgets": [{}]})"));
  EXPECT_EQ(*panel.Read(), kPanel);
}

TEST(PanelFile, AFileThatIsNoPanelIsToldWithItsName) {
  const TemporaryFolder folder;
  PanelFile panel((folder.path() / "robot.xml").string());
  std::ofstream(panel.file()) << "{";
  const auto read = panel.Read();
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().ToString(), HasSubstr("robot.panel.json"));
}

TEST(PanelFile, WithoutAFileItIsKeptInMemoryAndSaysSo) {
  PanelFile panel("");
  EXPECT_EQ(*panel.Read(), "");
  const auto done = panel.Save(kPanel);
  ASSERT_TRUE(done);
  EXPECT_THAT(*done, HasSubstr("in memory until the application ends"));
  EXPECT_EQ(*panel.Read(), kPanel);
  EXPECT_FALSE(panel.Save("{}"));
  EXPECT_EQ(*panel.Read(), kPanel);
}

}  // namespace
}  // namespace runnel::test
