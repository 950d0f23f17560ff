#include "core/base/error.h"

#include <cerrno>

#include <gtest/gtest.h>

namespace runnel {
namespace {

const Error kWhole{.message = "there is no field 'z'",
                   .path = "/robot/planner/goal",
                   .position = {"robot.xml", 3, 5},
                   .hint = "did you mean 'x'?"};

TEST(ErrorTest, AContextStandsBeforeTheMessageAndAllElseStays) {
  Error expected = kWhole;
  expected.message = "parameter 'goal': there is no field 'z'";
  EXPECT_EQ(kWhole.WithContext("parameter 'goal'"), expected);
}

TEST(ErrorTest, ContextsStandFromTheOutermostInwards) {
  const Error error{.message = "is no number"};
  EXPECT_EQ(error.WithContext("goal.x").WithContext("the panel").message, "the panel: goal.x: is no number");
}

TEST(ErrorTest, APathIsGivenToAnErrorThatHasNone) {
  Error expected = kWhole;
  expected.path = "/robot/other";
  Error error = kWhole;
  error.path.clear();
  EXPECT_EQ(error.WithPath("/robot/other"), expected);
  EXPECT_EQ(kWhole.WithPath("/robot/other"), kWhole);
}

TEST(ErrorTest, APlaceIsGivenToAnErrorThatHasNone) {
  Error expected = kWhole;
  expected.position = {"other.xml", 1};
  Error error = kWhole;
  error.position = {};
  EXPECT_EQ(error.WithPosition({"other.xml", 1}), expected);
  EXPECT_EQ(kWhole.WithPosition({"other.xml", 1}), kWhole);
}

TEST(ErrorTest, AnErrorOfTheSystemSaysWhyByErrno) {
  errno = ENOENT;
  EXPECT_EQ(SystemError("cannot be read", "map.png").ToString(), "map.png: cannot be read: No such file or directory");
  errno = EACCES;
  EXPECT_EQ(SystemError("no event can be made"), (Error{.message = "no event can be made: Permission denied"}));
}

}  // namespace
}  // namespace runnel
