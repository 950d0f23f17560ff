// What a whole application does in its cycles, from the first hit point on: no allocation.

#include <optional>

#include <gtest/gtest.h>

#include "plugins/testing/guards.h"
#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

class HotPath : public testing::TestWithParam<const char*> {};

TEST_P(HotPath, AllocatesNothingAfterStartUp) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "sanitizers have a malloc of their own";
  // Pools grow and lists find their size in the first cycles.
  constexpr int kStartUp = 20;
  int cycles = 0;
  std::size_t allocations = 0;
  std::optional<AllocationGuard> guard;
  const auto run =
      RunApplication({.name = GetParam(),
                      .arguments = {"world=" RUNNEL_XML "/worlds/one_obstacle.xml", "noise=0.01", "picture="},
                      .before_step = [&] { guard.emplace(); },
                      .after_step =
                          [&] {
                            if (++cycles > kStartUp) allocations += guard->allocations();
                          }});
  ASSERT_TRUE(run.outcome);
  EXPECT_GT(cycles, 10 * kStartUp);
  EXPECT_EQ(allocations, 0u);
}

INSTANTIATE_TEST_SUITE_P(Sensors, HotPath, testing::Values("bug_demo.xml", "bug_infrared.xml"),
                         [](const auto& application) {
                           return std::string(application.index == 0 ? "Laser" : "Infrared");
                         });

}  // namespace
}  // namespace runnel::test
