#include "core/base/nearest_name.h"

#include <vector>

#include <gtest/gtest.h>

namespace runnel {
namespace {

const std::vector<std::string> kPorts{"scan", "pose", "velocity", "goal_reached"};

TEST(EditDistanceTest, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(EditDistance("scan", "scan"), 0);
  EXPECT_EQ(EditDistance("scan", "scans"), 1);
  EXPECT_EQ(EditDistance("scan", "can"), 1);
  EXPECT_EQ(EditDistance("scan", "scon"), 1);
  EXPECT_EQ(EditDistance("scan", "scna"), 1);
  EXPECT_EQ(EditDistance("", "abc"), 3);
}

TEST(NearestNameTest, FindsATypingErrorWhateverItsCase) {
  EXPECT_EQ(NearestName("scna", kPorts), "scan");
  EXPECT_EQ(NearestName("Velocty", kPorts), "velocity");
  EXPECT_EQ(NearestName("goalreached", kPorts), "goal_reached");
}

TEST(NearestNameTest, OffersNothingThatIsFar) { EXPECT_EQ(NearestName("temperature", kPorts), ""); }

TEST(NearestNameHintTest, ListsWhatThereIsWhenNothingIsNear) {
  EXPECT_EQ(NearestNameHint("scna", kPorts), "did you mean 'scan'?");
  EXPECT_EQ(NearestNameHint("temperature", kPorts), "there is 'scan', 'pose', 'velocity', 'goal_reached'");
  EXPECT_EQ(NearestNameHint("x", {}), "there is none");
}

}  // namespace
}  // namespace runnel
