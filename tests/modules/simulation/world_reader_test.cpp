#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/world_file/world_file.h"

namespace runnel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string InWorld(const std::string& content) {
  return "<world name=\"w\">\n<start x=\"-6\" y=\"0\"/> <goal x=\"7\" y=\"0\"/>\n" + content + "</world>";
}

/// What is wrong with the text, as "line: message; hint".
std::vector<std::string> ErrorsIn(const std::string& text) {
  Diagnostics diagnostics;
  const auto world = ReadWorld(text, "w.xml", diagnostics);
  EXPECT_EQ(world.has_value(), diagnostics.ok());
  std::vector<std::string> errors;
  for (const Error& error : diagnostics.errors()) {
    EXPECT_EQ(error.position.file, "w.xml");
    errors.push_back(std::to_string(error.position.line) + ": " + error.message +
                     (error.hint.empty() ? "" : "; " + error.hint));
  }
  return errors;
}

World Good(const std::string& text) {
  Diagnostics diagnostics;
  auto world = ReadWorld(text, "w.xml", diagnostics);
  if (!world) throw std::runtime_error(diagnostics.ToString());
  return *world;
}

TEST(ReadWorld, TakesEveryPartWithItsNumbers) {
  const World world = Good(R"(<world name="cup">
    <start x="-6" y="0.4" heading="1.5"/> <goal x="7" y="-0.4"/>
    <polygon height="0.5"> <point x="0" y="0"/> <point x="4" y="0"/> <point x="0" y="4"/>
      <hole> <point x="0.5" y="0.5"/> <point x="1" y="0.5"/> <point x="0.5" y="1"/> </hole>
    </polygon>
    <box x="1" y="-3" heading="0.2" length="2" width="1" height="3"/>
    <cylinder x="-1" y="-3" radius="0.75"/>
    <wall thickness="0.1"> <point x="-2" y="1"/> <point x="-2" y="3"/> </wall>
    <bounds> <point x="-9" y="-9"/> <point x="9" y="-9"/> <point x="0" y="20"/> </bounds>
  </world>)");
  EXPECT_EQ(world.name, "cup");
  EXPECT_EQ(world.start, (Pose2{-6, 0.4, 1.5}));
  EXPECT_EQ(world.goal, (Point2{7, -0.4}));
  EXPECT_THAT(world.polygons,
              ElementsAre(PolygonObstacle{
                  .outline = {{0, 0}, {4, 0}, {0, 4}}, .holes = {{{0.5, 0.5}, {1, 0.5}, {0.5, 1}}}, .height = 0.5}));
  EXPECT_THAT(world.boxes, ElementsAre(BoxObstacle{{1, -3, 0.2}, 2, 1, 3}));
  EXPECT_THAT(world.cylinders, ElementsAre(CylinderObstacle{{-1, -3}, 0.75, 1}));
  EXPECT_THAT(world.walls, ElementsAre(WallObstacle{{{-2, 1}, {-2, 3}}, 0.1, 1}));
  EXPECT_EQ(world.bounds, (Ring{{-9, -9}, {9, -9}, {0, 20}}));
}

TEST(ReadWorld, StartsInARoomThatIsAHole) {
  EXPECT_THAT(ErrorsIn(InWorld(R"(<polygon>
      <point x="-9" y="-9"/> <point x="-1" y="-9"/> <point x="-1" y="9"/> <point x="-9" y="9"/>
      <hole> <point x="-8" y="-8"/> <point x="-8" y="8"/> <point x="-2" y="8"/>
        <point x="-2" y="-8"/> </hole> </polygon>)")),
              IsEmpty());
}

TEST(ReadWorld, AllowsAGoalInsideAnObstacle) {
  EXPECT_THAT(ErrorsIn(InWorld("<cylinder x='7' y='0' radius='1'/>")), IsEmpty());
}

TEST(ReadWorld, WantsAStartAGoalAndAName) {
  EXPECT_THAT(ErrorsIn("<!-- nothing -->\n<world/>"),
              ElementsAre(HasSubstr("2: <world> has no 'name'"), HasSubstr("2: the world has no <start>"),
                          HasSubstr("2: the world has no <goal>")));
}

TEST(ReadWorld, RefusesASecondStart) {
  EXPECT_THAT(ErrorsIn(InWorld("<start x='1' y='1'/>")),
              ElementsAre("3: the world has a second <start>; the first is in line 2"));
}

TEST(ReadWorld, RefusesAnotherRoot) {
  EXPECT_THAT(ErrorsIn("<robot/>"), ElementsAre(HasSubstr("1: a world file begins with <world>")));
}

TEST(ReadWorld, RefusesWhatIsNoXml) { EXPECT_EQ(ErrorsIn("<world").size(), 1U); }

TEST(ReadWorld, NamesTheNearestElementAndAttribute) {
  EXPECT_THAT(ErrorsIn(InWorld("\n<cilinder x='1' y='1' radius='1'/>\n"
                               "<cylinder x='1' y='1' radius='1' hieght='2'/>")),
              ElementsAre("4: no <cilinder> may stand in <world>; did you mean 'cylinder'?",
                          "5: <cylinder> knows no 'hieght'; did you mean 'height'?"));
}

TEST(ReadWorld, WantsNumbers) {
  EXPECT_THAT(ErrorsIn(InWorld("<box x='here' y='1'\nlength='1' width='nan'/>")),
              ElementsAre(HasSubstr("3: x=\"here\" is no number"), HasSubstr("4: width=\"nan\" is no number")));
}

TEST(ReadWorld, SaysNothingMoreAboutGeometryWithoutNumbers) {
  EXPECT_THAT(ErrorsIn("<world name='w'>\n<start x='0' y='?'/><goal x='1' y='1'/>\n"
                       "<polygon><point x='1' y='1'/><point x='3'/><point x='1' y='3'/>\n"
                       "<hole><point x='1' y='1'/></hole></polygon> <cylinder x='0' y='0' radius='1'/>"
                       "</world>"),
              ElementsAre(HasSubstr("2: y=\"?\" is no number"), HasSubstr("3: <point> has no 'y'"),
                          "4: the hole has 1 point, but needs at least 3"));
}

TEST(ReadWorld, WithoutAStartNothingIsSaidToBeInTheWayOfIt) {
  EXPECT_THAT(ErrorsIn("<world name='w'><goal x='1' y='1'/><cylinder x='0' y='0' radius='1'/>"
                       "</world>"),
              ElementsAre(HasSubstr("1: the world has no <start>")));
}

TEST(ReadWorld, RefusesSizesOfZeroAndLess) {
  EXPECT_THAT(ErrorsIn(InWorld("<box x='1' y='1' length='0' width='-1'/>\n"
                               "<cylinder x='1' y='1' radius='0'/>\n"
                               "<wall thickness='0'><point x='0' y='0'/><point x='1' y='0'/></wall>\n"
                               "<cylinder x='1' y='1' radius='1' height='0'/>")),
              ElementsAre("3: the length must be more than 0 m, not 0", "3: the width must be more than 0 m, not -1",
                          "4: the radius must be more than 0 m, not 0", "6: the height must be more than 0 m, not 0",
                          "5: the thickness must be more than 0 m, not 0"));
}

TEST(ReadWorld, RefusesRingsOfTwoPoints) {
  EXPECT_THAT(ErrorsIn(InWorld("<polygon><point x='0' y='0'/><point x='1' y='0'/></polygon>\n"
                               "<bounds/>\n<wall thickness='1'><point x='0' y='0'/></wall>")),
              ElementsAre("3: the polygon has 2 points, but needs at least 3", "5: the wall needs at least 2 points",
                          "4: the ring of the bounds has 0 points, but needs at least 3"));
}

TEST(ReadWorld, RefusesARingThatCrossesItself) {
  EXPECT_THAT(ErrorsIn(InWorld("\n<polygon><point x='0' y='0'/><point x='2' y='2'/>"
                               "<point x='2' y='0'/><point x='0' y='2'/></polygon>")),
              ElementsAre("4: the polygon crosses or touches itself: its side from (0, 0) to (2, 2) "
                          "meets the one from (2, 0) to (0, 2)"));
}

TEST(ReadWorld, RefusesAHoleOutsideItsPolygonAtTheLineOfTheHole) {
  EXPECT_THAT(ErrorsIn(InWorld("<polygon><point x='0' y='0'/><point x='2' y='0'/><point x='0' y='2'/>\n"
                               "<hole><point x='5' y='5'/><point x='6' y='5'/><point x='5' y='6'/></hole>\n"
                               "</polygon>")),
              ElementsAre("4: the hole is not within its polygon"));
}

TEST(ReadWorld, RefusesAStartInsideAnObstacleOrOutsideTheBounds) {
  EXPECT_THAT(
      ErrorsIn(InWorld("<cylinder x='-6' y='0.5' radius='1'/>\n"
                       "<bounds><point x='0' y='-9'/><point x='9' y='0'/><point x='0' y='9'/></bounds>")),
      ElementsAre("3: the start (-6, 0) is inside this obstacle", "4: the start (-6, 0) is outside the bounds"));
}

TEST(ReadWorld, RefusesTextAndMisplacedElements) {
  EXPECT_THAT(ErrorsIn(InWorld("<box x='0' y='0' length='1' width='1'><point/></box>\n"
                               "<wall thickness='1'>stone<point x='0' y='0'/><point x='1' y='0'/>"
                               "</wall>")),
              ElementsAre(HasSubstr("3: no <point> may stand in <box>"), HasSubstr("4: no text may stand in <wall>")));
}

TEST(ReadWorldFile, TellsOfAMissingFile) {
  Diagnostics diagnostics;
  EXPECT_FALSE(ReadWorldFile("/nowhere/world.xml", diagnostics).has_value());
  ASSERT_EQ(diagnostics.errors().size(), 1U);
  EXPECT_EQ(diagnostics.errors()[0].position.file, "/nowhere/world.xml");
}

}  // namespace
}  // namespace runnel
