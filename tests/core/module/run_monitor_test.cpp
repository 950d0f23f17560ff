#include "core/module/run_monitor.h"

#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "core/module/group.h"

namespace runnel::test {
namespace {

class OneStep final : public RunMonitor {
 public:
  std::string Progress() const override { return "on the way"; }
  std::optional<RunOutcome> Outcome() const override {
    if (!over) return std::nullopt;
    return RunOutcome{.verdict = "reached", .summary = "1 step", .success = true};
  }
  bool over = false;
};

// The base is the key: a program asks for RunMonitor and need not know what derives from it.
TEST(RunMonitorTest, IsFoundByItsBase) {
  Runtime runtime;
  auto& group = runtime.Create<Group>(runtime.root(), "group");
  auto monitor = std::make_unique<OneStep>();
  OneStep& judge = *monitor;
  group.Annotate<RunMonitor>(std::move(monitor));
  auto* found = group.FindAnnotation<RunMonitor>();
  ASSERT_EQ(found, &judge);
  EXPECT_EQ(found->Progress(), "on the way");
  EXPECT_FALSE(found->Outcome());
  judge.over = true;
  EXPECT_EQ(found->Outcome()->verdict, "reached");
  EXPECT_EQ(*found->Finish(), "");
}

}  // namespace
}  // namespace runnel::test
