#include "tests/integration/stop_search/stop_search.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

TEST(StopSearch, NothingGetsAroundAStop) {
  const StopSearchResult found = SearchForWaysAroundStop(1, 300);
  EXPECT_THAT(found.violations, testing::IsEmpty());
  // It has looked at what it is about.
  EXPECT_GT(found.presses, 5u);
  EXPECT_GT(found.reloads, 2u);
  EXPECT_GT(found.checks_in_force, 100u);
  EXPECT_GT(found.came_back, 0u) << "nothing that was deleted came back";
  EXPECT_GT(found.moving, 100u) << "a robot that never moves need not be stopped";
  EXPECT_LT(found.refused, found.steps / 4);
}

}  // namespace
}  // namespace runnel::test
