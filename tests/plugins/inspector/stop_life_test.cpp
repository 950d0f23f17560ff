// Signs of life by which viewers know how the STOP stands, and the robot that somebody is there.

#include <chrono>
#include <utility>

#include "tests/plugins/inspector/viewers_stop.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

// What comes may have been sent long ago: only the sign of life that it answers says when.
TEST_F(ViewersStop, WhoMayDriveIsHeardAsOfTheSignOfLifeThatIsAnswered) {
  Start({}, LookAndDrive());
  OperatorWatch& operators = service->operators();
  operators.Begin(1h);
  Viewer looks = Connect("runnel.stop.v1", WebRole::kLook);
  Viewer drives = Connect("runnel.stop.v1", WebRole::kDrive);
  const auto begun = operators.Look();
  const double first = looks.Next("alive")["at"];
  looks.Send({{"op", "alive"}, {"at", first}});
  looks.Ask({{"op", "stop"}});
  EXPECT_EQ(operators.Look(), begun) << "who only looks is not heard";
  const double second = drives.Next("alive")["at"];
  drives.Send({{"op", "alive"}});
  for (const double at : {first - 10, second + 1000, 1e300, -1e300}) drives.Send({{"op", "alive"}, {"at", at}});
  drives.Ask({{"op", "stop"}, {"at", second}});
  EXPECT_EQ(operators.Look(), begun) << "by what came before or says no good time";
  drives.Send({{"op", "alive"}, {"at", second}});
  drives.Send({{"op", "alive"}, {"at", first}});
  drives.Ask({{"op", "stop"}});
  EXPECT_EQ(operators.Look(), Time(FromSeconds(second)) + 1h);
}

TEST_F(ViewersStop, GivesASignOfLifeAsOftenAsItMustBeAnswered) {
  Start();
  service->operators().Begin(200ms);
  Viewer viewer(server->port(), "", "runnel.stop.v1");
  WaitUntil("nobody is heard", [&] { return in_force(); });
  const auto begun = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) viewer.Next("alive");
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 15s) << "once a second is not enough";
}

TEST_F(ViewersStop, ItsOwnConnectionKnowsNothingElse) {
  Start();
  Viewer stop(server->port(), "", "runnel.stop.v1");
  const Json reply = stop.Ask({{"op", "save"}});
  EXPECT_EQ(reply["ok"], false);
  EXPECT_THAT(reply["errors"][0]["message"], HasSubstr("knows no 'save'"));
  EXPECT_EQ(stop.Ask({{"op", 7}})["ok"], false);
  EXPECT_EQ(stop.Ask({{"op", "release"}, {"path", "/app/a/output/out"}})["ok"], false);
  EXPECT_FALSE(in_force());
  double before = 0;
  for (int i = 0; i < 2; ++i) {
    const Json alive = stop.Next("alive");
    EXPECT_EQ(alive["stop"]["in_force"], false);
    EXPECT_GT(alive["at"].get<double>(), std::exchange(before, alive["at"].get<double>())) << "old ones are told by it";
  }
}

}  // namespace
}  // namespace runnel::test
