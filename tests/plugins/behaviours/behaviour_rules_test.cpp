#include "plugins/behaviours/algorithm/behaviour_rules.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"

namespace runnel {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(ActivationTest, IsStimulationLessTheStrongestInhibition) {
  EXPECT_DOUBLE_EQ(Activation(0.8, std::vector{0.25, 0.5, 0.1}), 0.4);
  EXPECT_DOUBLE_EQ(Activation(0.8, {}), 0.8);
  EXPECT_DOUBLE_EQ(Activation(1.0, std::vector{1.0}), 0.0);
}

// The same by other means: exact numbers, 65535 for 1.
TEST(ActivationTest, AgreesWithAnIndependentReckoning) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> any(0, 65535);
  std::uniform_int_distribution<int> count(0, 8);
  for (int round = 0; round < 5000; ++round) {
    const std::int64_t stimulation = any(random);
    std::vector<double> inhibitions;
    std::int64_t least_left = 65535;
    for (int i = count(random); i > 0; --i) {
      const std::int64_t each = any(random);
      inhibitions.push_back(static_cast<double>(each) / 65535);
      least_left = std::min(least_left, 65535 - each);
    }
    const double expected = static_cast<double>(stimulation * least_left) / (65535.0 * 65535.0);
    EXPECT_NEAR(Activation(static_cast<double>(stimulation) / 65535, inhibitions), expected, 1e-12);
  }
}

TEST(BehaviourRulesTest, KeepsToTheActivation) {
  EXPECT_THAT(FindViolation({.now = {0.5, 0.5, 1.0}}), IsEmpty());
  EXPECT_EQ(FindViolation({.now = {0.5, 0.75, 1.0}}), "its activity 0.75 is greater than its activation 0.5");
}

TEST(BehaviourRulesTest, DerivedActivitiesKeepToTheActivity) {
  const std::vector right{0.0, 0.5}, wrong{0.25, 0.75}, negative{-0.25};
  EXPECT_THAT(FindViolation({.now = {1.0, 0.5, 1.0}, .derived = right}), IsEmpty());
  EXPECT_EQ(FindViolation({.now = {1.0, 0.5, 1.0}, .derived = wrong}),
            "its derived activity 2 is 0.75, which is not within 0 and its activity 0.5");
  EXPECT_THAT(FindViolation({.now = {1.0, 0.5, 1.0}, .derived = negative}), HasSubstr("is -0.25"));
}

TEST(BehaviourRulesTest, AllIsWithinZeroAndOne) {
  EXPECT_EQ(FindViolation({.now = {1.0, 0.5, 1.5}}), "target rating is 1.5, which is not within 0 and 1");
  EXPECT_EQ(FindViolation({.now = {1.0, -0.5, 1.0}}), "activity is -0.5, which is not within 0 and 1");
  EXPECT_THAT(FindViolation({.now = {1.0, kNaN, 1.0}}), HasSubstr("activity is"));
  const std::vector derived{kNaN};
  EXPECT_THAT(FindViolation({.now = {1.0, 0.5, 1.0}, .derived = derived}), Not(IsEmpty()));
}

TEST(BehaviourRulesTest, InTheGoalStateTheActivityStays) {
  const MetaSignals before{1.0, 0.25, 0.0};
  const BehaviourCycle changed{.now = {1.0, 0.5, 0.0}, .before = before, .has_same_activities = true};
  EXPECT_EQ(FindViolation(changed),
            "its activity has changed from 0.25 to 0.5 in the goal state (target rating 0, activation 1)");
  BehaviourCycle other = changed;
  other.has_same_activities = false;
  EXPECT_THAT(FindViolation(other), IsEmpty()) << "an activity that it reads has changed";
  other = changed;
  other.before->activation = 0.75;
  EXPECT_THAT(FindViolation(other), IsEmpty()) << "so has its activation";
  other = changed;
  other.before->target_rating = 0.5;
  EXPECT_THAT(FindViolation(other), IsEmpty()) << "it has not been content";
  other = changed;
  other.now.target_rating = 0.5;
  EXPECT_THAT(FindViolation(other), IsEmpty()) << "it is not content any more";
  other = changed;
  other.before.reset();
  EXPECT_THAT(FindViolation(other), IsEmpty()) << "there is no before";
}

// Each cycle is judged by the letter of the rules, one after the other.
TEST(BehaviourRulesTest, AgreesWithAnIndependentReckoning) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> quarter(-1, 5);
  const auto any = [&] { return quarter(random) / 4.0; };
  int wrong_ones = 0;
  for (int round = 0; round < 20000; ++round) {
    const MetaSignals now{any(), any(), any()}, before{any(), any(), any()};
    const std::vector<double> derived{any(), any()};
    const bool same = round % 2 == 0;
    bool is_right = true;
    for (const double each : {now.activation, now.activity, now.target_rating})
      is_right = is_right && each >= 0 && each <= 1;
    is_right = is_right && !(now.activity > now.activation);
    for (const double each : derived) is_right = is_right && !(each < 0) && !(each > now.activity);
    const bool is_goal_state =
        now.target_rating == 0 && before.target_rating == 0 && now.activation == before.activation && same;
    is_right = is_right && (!is_goal_state || now.activity == before.activity);
    const std::string violation =
        FindViolation({.now = now, .derived = derived, .before = before, .has_same_activities = same});
    EXPECT_EQ(violation.empty(), is_right) << violation;
    wrong_ones += is_right ? 0 : 1;
  }
  EXPECT_GT(wrong_ones, 1000);
  EXPECT_LT(wrong_ones, 20000);
}

TEST(BehaviourRulesTest, RoundingIsCutOff) {
  EXPECT_EQ(CutRounding(0.1 + 0.2, 0.3), 0.3);
  EXPECT_EQ(CutRounding(-1e-17, 0.3), 0.0);
  EXPECT_EQ(CutRounding(0.31, 0.3), 0.31);
  EXPECT_EQ(CutRounding(-0.01, 0.3), -0.01);
  EXPECT_EQ(CutRounding(0.2, 0.3), 0.2);
}

}  // namespace
}  // namespace runnel
