#include "plugins/wire/matched_ends.h"

#include <gtest/gtest.h>

#include "plugins/testing/fault_injection.h"

namespace runnel::test {
namespace {

TEST(MatchedEnds, AreThoseThatHaveComeAndNotGone) {
  MatchedEnds ends;
  EXPECT_EQ(ends.Change(1, true), 1U);
  EXPECT_EQ(ends.Change(2, true), 2U);
  EXPECT_EQ(ends.Change(2, true), 2U) << "each once";
  EXPECT_EQ(ends.Change(1, false), 1U);
  EXPECT_FALSE(ends.Has(1));
  EXPECT_TRUE(ends.Has(2));
  EXPECT_EQ(ends.Change(3, false), 1U) << "it has not come";
}

// Of each it is told once: if it were forgotten, nothing would be sent to it for ever after.
TEST(MatchedEnds, OneThatThereIsNoMemoryToNoteCounts) {
  MatchedEnds ends;
  EXPECT_EQ(ends.Change(1, true), 1U);
  FaultInjection injection(InjectedFault::kAllocation, 1);
  EXPECT_EQ(ends.Change(2, true), 2U);
  injection.End();
  EXPECT_TRUE(injection.has_struck());
  EXPECT_TRUE(ends.Has(2));
  EXPECT_EQ(ends.Change(2, false), 1U);
  EXPECT_FALSE(ends.Has(2));
  EXPECT_TRUE(ends.Has(1));
}

}  // namespace
}  // namespace runnel::test
