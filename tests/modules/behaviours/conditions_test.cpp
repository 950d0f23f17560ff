#include "modules/behaviours/algorithm/conditions.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(ConditionsTest, RelationsAreWhatTheySay) {
  EXPECT_TRUE(Holds(2, Relation::kGreater, 1));
  EXPECT_FALSE(Holds(1, Relation::kGreater, 1));
  EXPECT_TRUE(Holds(1, Relation::kAtLeast, 1));
  EXPECT_FALSE(Holds(0, Relation::kAtLeast, 1));
  EXPECT_TRUE(Holds(1, Relation::kEqual, 1));
  EXPECT_FALSE(Holds(2, Relation::kEqual, 1));
  EXPECT_TRUE(Holds(1, Relation::kAtMost, 1));
  EXPECT_FALSE(Holds(2, Relation::kAtMost, 1));
  EXPECT_TRUE(Holds(0, Relation::kLess, 1));
  EXPECT_FALSE(Holds(1, Relation::kLess, 1));
  EXPECT_TRUE(Holds(0, Relation::kNotEqual, 1));
  EXPECT_FALSE(Holds(1, Relation::kNotEqual, 1));
}

ConditionState Of(ConditionKind kind) { return {.condition = {kind, Relation::kGreater, 0.5}}; }

TEST(ConditionsTest, OrderingOnesRemember) {
  std::vector states{Of(ConditionKind::kOrdering)};
  EXPECT_FALSE(AreAllTrue(states));
  states[0].value = 1;
  EXPECT_TRUE(AreAllTrue(states));
  states[0].value = 0;
  EXPECT_TRUE(AreAllTrue(states));
  Reset(states);
  EXPECT_FALSE(AreAllTrue(states));
}

TEST(ConditionsTest, EnablingOnesWaitForTheOthersAndForgetWithThem) {
  std::vector states{Of(ConditionKind::kPermanent), Of(ConditionKind::kEnabling)};
  states[1].value = 1;
  EXPECT_FALSE(AreAllTrue(states)) << "it is not looked at yet";
  states[0].value = 1;
  states[1].value = 0;
  EXPECT_FALSE(AreAllTrue(states));
  states[1].value = 1;
  EXPECT_TRUE(AreAllTrue(states));
  states[1].value = 0;
  EXPECT_TRUE(AreAllTrue(states)) << "it remembers";
  states[0].value = 0;
  EXPECT_FALSE(AreAllTrue(states));
  states[0].value = 1;
  EXPECT_FALSE(AreAllTrue(states)) << "it has forgotten";
}

TEST(ConditionsTest, NoneAreTrue) { EXPECT_TRUE(AreAllTrue({})); }

// Told from the whole past of each condition instead of from what is remembered.
TEST(ConditionsTest, AgreesWithAnIndependentReckoning) {
  std::mt19937 random(7);
  std::bernoulli_distribution coin(0.5), seldom(0.05);
  for (int run = 0; run < 300; ++run) {
    const auto count = static_cast<std::size_t>(run % 4 + 1);
    std::vector<ConditionState> states(count);
    for (ConditionState& each : states) {
      each = Of(static_cast<ConditionKind>(std::uniform_int_distribution(0, 2)(random)));
    }
    std::vector<std::vector<bool>> past;  // of each cycle since the reset, what held
    for (int cycle = 0; cycle < 30; ++cycle) {
      if (seldom(random)) {
        Reset(states);
        past.clear();
      }
      std::vector<bool> holds(count);
      for (std::size_t i = 0; i < count; ++i) {
        holds[i] = coin(random);
        states[i].value = holds[i] ? 1.0 : 0.0;
      }
      past.push_back(holds);
      const auto are_basic_true_at = [&](std::size_t end) {
        for (std::size_t i = 0; i < count; ++i) {
          if (states[i].condition.kind == ConditionKind::kEnabling) continue;
          bool is_true = past[end][i];
          for (std::size_t t = 0; t < end && states[i].condition.kind == ConditionKind::kOrdering; ++t) {
            is_true = is_true || past[t][i];
          }
          if (!is_true) return false;
        }
        return true;
      };
      bool expected = are_basic_true_at(past.size() - 1);
      for (std::size_t i = 0; i < count && expected; ++i) {
        if (states[i].condition.kind != ConditionKind::kEnabling) continue;
        bool is_enabled = false;
        for (std::size_t t = past.size(); t-- > 0 && are_basic_true_at(t);) is_enabled = is_enabled || past[t][i];
        expected = is_enabled;
      }
      ASSERT_EQ(AreAllTrue(states), expected) << "run " << run << ", cycle " << cycle;
    }
  }
}

}  // namespace
}  // namespace runnel
