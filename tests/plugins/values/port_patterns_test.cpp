#include "plugins/values/port_patterns.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

bool Fits(const std::vector<std::string>& patterns, const std::string& path) {
  return PortPatterns::Make(patterns)->Fit(path);
}

TEST(PortPatterns, WithoutAnyAllPortsFit) { EXPECT_TRUE(Fits({}, "/app/robot/output/pose")); }

TEST(PortPatterns, TheApplicationAndThePortsGroupMayBeLeftOut) {
  for (const char* pattern :
       {"/app/robot/output/pose", "/app/robot/pose", "/robot/pose", "robot/pose", "pose", "/robot/output/pose"}) {
    EXPECT_TRUE(Fits({pattern}, "/app/robot/output/pose")) << pattern;
  }
  EXPECT_FALSE(Fits({"/pose"}, "/app/robot/output/pose"));
  EXPECT_FALSE(Fits({"/robot/pos"}, "/app/robot/output/pose"));
  EXPECT_TRUE(Fits({"/base/pose"}, "/app/base/sensor_output/pose"));
}

TEST(PortPatterns, AStarStandsForAPartAndTwoForAnyNumber) {
  EXPECT_TRUE(Fits({"*/pose"}, "/app/robot/output/pose"));
  EXPECT_TRUE(Fits({"/robot/**"}, "/app/robot/planner/output/twist"));
  EXPECT_TRUE(Fits({"/robot/**"}, "/app/robot/output/pose"));
  EXPECT_FALSE(Fits({"/robot/*"}, "/app/robot/planner/output/twist"));
  EXPECT_FALSE(Fits({"/laser/**"}, "/app/robot/output/pose"));
  EXPECT_TRUE(Fits({"**/pla*er/tw*t"}, "/app/robot/planner/output/twist"));
  EXPECT_FALSE(Fits({"**/pla*er/tw*t"}, "/app/robot/planner/output/twister"));
}

TEST(PortPatterns, OneOfSeveralIsEnoughAndExclusionsWin) {
  const std::vector<std::string> patterns{"/robot/**", "scan", "!**/points"};
  EXPECT_TRUE(Fits(patterns, "/app/laser/output/scan"));
  EXPECT_TRUE(Fits(patterns, "/app/robot/planner/output/twist"));
  EXPECT_FALSE(Fits(patterns, "/app/robot/planner/output/points"));
  EXPECT_FALSE(Fits(patterns, "/app/world/output/scene"));
  EXPECT_TRUE(Fits({"!scan"}, "/app/robot/output/pose"));
  EXPECT_FALSE(Fits({"!scan"}, "/app/laser/output/scan"));
}

TEST(PortPatterns, MayStandInAListWithCommas) {
  const std::vector<std::string> patterns{"/laser/*,/robot/**", "!**/points"};
  EXPECT_TRUE(Fits(patterns, "/app/laser/output/scan"));
  EXPECT_TRUE(Fits(patterns, "/app/robot/planner/output/twist"));
  EXPECT_FALSE(Fits(patterns, "/app/robot/planner/output/points"));
  EXPECT_FALSE(PortPatterns::Make({"/laser/*,"}));
}

TEST(PortPatterns, KnowsWhichNameOnePort) {
  const auto patterns = PortPatterns::Make({"/laser/scan", "**/pose", "!x/y"});
  EXPECT_THAT(patterns->Names(), testing::ElementsAre("/laser/scan"));
  EXPECT_TRUE(patterns->Name("/app/laser/output/scan"));
  EXPECT_FALSE(patterns->Name("/app/robot/output/pose"));
}

TEST(PortPatterns, RefusesWhatIsNone) {
  for (const char* bad : {"", "/", "!", "!/"}) {
    const auto made = PortPatterns::Make({bad});
    ASSERT_FALSE(made) << bad;
    EXPECT_THAT(made.error().message, testing::HasSubstr("is no pattern of ports"));
  }
}

TEST(PortPatterns, ShortPathsAreThoseThatPeopleWrite) {
  EXPECT_EQ(ShortPortPath("/app/robot/output/pose"), "/robot/pose");
  EXPECT_EQ(ShortPortPath("/app/robot/wheels"), "/robot/wheels");
  EXPECT_EQ(ShortPortPath("/pose"), "/pose");
}

}  // namespace
}  // namespace runnel::test
