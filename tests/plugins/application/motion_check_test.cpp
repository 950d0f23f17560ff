// `runnel check` of applications in which something moves.

#include <fstream>

#include <gmock/gmock.h>

#include "plugins/application/application_description.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

std::string Checked(const std::string& inside) {
  const TemporaryFolder folder;
  std::ofstream(folder / "app.xml") << "<application name=\"app\">\n<load plugin=\"states\"/>\n"
                                    << inside << "\n</application>\n";
  ApplicationOptions options;
  options.plugin_folders = {RUNNEL_TEST_STATES_PLUGIN};
  ApplicationDescription description(std::move(options));
  (void)description.Read(folder / "app.xml");
  description.RunChecks({});
  return description.diagnostics().ToString();
}

TEST(MotionCheck, WarnsWhereSomethingMovesAndNothingIsMarked) {
  EXPECT_THAT(Checked("<module name='m' type='states/filter'/>"),
              ::testing::HasSubstr("app.xml:3:1: warning: /app/m/input/in: takes velocities, and no port of the "
                                   "application is marked as driving"));
}

TEST(MotionCheck, IsContentWithAMarkAndWhereNothingMoves) {
  EXPECT_EQ(Checked("<module name='m' type='states/filter'/><driving port='m/queued'/>"), "");
  EXPECT_EQ(Checked("<module name='m' type='states/source'/>"), "");
}

constexpr const char* kShared =
    "<thread name='control' period='10ms'/>\n"
    "<module name='s' type='states/source'/>\n"
    "<module name='t' type='states/source'/>\n"
    "<module name='m' type='states/filter'/><driving port='m/queued'/>";

TEST(MotionCheck, NamesAModuleThatDrivesAndSharesItsThread) {
  EXPECT_THAT(
      Checked(kShared),
      ::testing::AllOf(::testing::HasSubstr("app.xml:6:1: warning: /app/m: something moves by it, and the thread "
                                            "'control' runs 2 other modules"),
                       ::testing::HasSubstr("give it a thread of its own: <thread name=\"drive\"")));
}

TEST(MotionCheck, NamesModulesThatDriveAndShareTheirThreadWithEachOther) {
  EXPECT_THAT(
      Checked("<thread name='control' period='10ms'/>\n"
              "<module name='m' type='states/filter'/><driving port='m/queued'/>\n"
              "<module name='n' type='states/filter'/><driving port='n/queued'/>"),
      ::testing::AllOf(
          ::testing::HasSubstr("/app/m: something moves by it, and the thread 'control' runs 1 other module:"),
          ::testing::HasSubstr("/app/n: something moves by it, and the thread 'control' runs 1 other module:")));
}

TEST(MotionCheck, WarnsOfAMarkBeforeWhatMoves) {
  const std::string moves =
      "<module name='s' type='states/source'/><module name='m' type='states/filter'/><connect from='s/out' to='m/in'/>";
  EXPECT_THAT(
      Checked("<clock type='simulated'/>" + moves + "<driving port='s/out'/>"),
      ::testing::HasSubstr(
          "/app/s/output/out: is marked as driving, and not what moves by it: a STOP does not hold what another "
          "source sends to /app/m/input/in; mark that: <driving port=\"/app/m/input/in\"/>"));
  EXPECT_EQ(Checked("<clock type='simulated'/>" + moves + "<driving port='s/out'/><driving port='m/in'/>"), "");
}

// As the pulse of a motor controller, which stands still at 1500 us.
TEST(MotionCheck, WarnsOfRampsBeforeAVelocityWhoseSafeValueIsNotZero) {
  const std::string moves =
      "<load plugin='signal'/><clock type='simulated'/><module name='s' type='states/source'/>"
      "<module name='scale' type='signal/linear'/><module name='motor' type='signal/linear'/>"
      "<connect from='s/out' to='scale/in'/><connect from='scale/out' to='motor/in'/>";
  EXPECT_THAT(
      Checked(moves + "<driving port='motor/in' safe='1500' command='velocity'/>"),
      ::testing::HasSubstr("/app/scale/input/in: is passed on to /app/motor/input/in, whose safe value is not zero"));
  EXPECT_EQ(Checked(moves + "<driving port='motor/in' safe='0' command='velocity'/>"), "");
  EXPECT_EQ(Checked(moves + "<driving port='motor/in' safe='1500' command='velocity'/><driving port='scale/in' "
                            "safe='0' command='velocity'/>"),
            "");
}

TEST(MotionCheck, IsContentWithAThreadOfItsOwnAndOnASimulatedClock) {
  EXPECT_EQ(Checked("<thread name='control' period='10ms'/><thread name='drive' period='10ms'/>\n"
                    "<module name='s' type='states/source' thread='control'/>\n"
                    "<module name='m' type='states/filter' thread='drive'/><driving port='m/queued'/>"),
            "");
  EXPECT_EQ(Checked(std::string("<clock type='simulated'/>") + kShared), "");
}

}  // namespace
}  // namespace runnel::test
