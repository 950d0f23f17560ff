// What stops a module in the place of another one: what was marked of the place, then what it declares itself; and what there
// was before, on the way back.

#include <chrono>

#include "tests/plugins/application_tags/driving_swap_fixture.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

TEST_F(DrivingSwap, WhatWasNotMarkedIsAsTheNewModuleDeclares) {
  for (const char* const mark : kMarks) {
    Load("test/esc", mark);
    ASSERT_EQ(Safe(), 1500);
    ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/drive"}}));
    EXPECT_EQ(Safe(), 0) << mark;
    EXPECT_EQ(In().stop()->brake() != Duration{}, std::string(mark).find("brake") != std::string::npos);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

TEST_F(DrivingSwap, OfWhatWasAVelocityByItsUnitTheNewOneSaysItsSafeValue) {
  Load("test/motor", kMarks[1]);
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
  EXPECT_EQ(ReadUnderStop(), 1500);
}

TEST_F(DrivingSwap, OnesSafeValueIsNotThatOfAnotherUnit) {
  Load("test/esc", "");
  const auto refused = history_.Apply({ReplaceModule{"/demo/m", "test/motor"}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics.ToString(),
              HasSubstr("/demo/m/input/in: is in m/s, and its safe value, 1500, is not"));
  EXPECT_EQ(Safe(), 1500) << "as it was";
}

TEST_F(DrivingSwap, NorIsOneThatWasMarked) {
  Load("test/number", "  <driving port=\"m/in\" safe=\"1500\" command=\"velocity\"/>\n");
  EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
  EXPECT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
}

TEST_F(DrivingSwap, NorIsZeroOfAnEffortThatOfAPosition) {
  Load("test/throttle", "");
  EXPECT_FALSE(history_.Apply({ReplaceModule{"/demo/m", "test/servo"}}));
  EXPECT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}}));
}

// By a rule, as while what feeds it is paused, or for somebody who drives it no more.
TEST_F(DrivingSwap, WhatStandsAtRestDoesSoAtTheNewSafeValue) {
  for (const auto setter : {Port::Setter::kRule, Port::Setter::kPerson}) {
    Load("test/esc", "");
    const auto held = [&](const char* type, double value, double read) {
      ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(value)), setter));
      const auto slot = HandSlot::Of(In());
      slot->hold = std::make_unique<HandSlot::Hold>();
      slot->hold->safe_value = AnyValue(Safe());
      ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", type}}));
      EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), read);
      EXPECT_EQ(*static_cast<const double*>(HandSlot::Find(In())->hold->safe_value.get()), Safe());
    };
    held("test/drive", 1500, 0);
    held("test/esc", 0, 1500);
    held("test/drive", 1400, 1400);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

// Also where no stop is left.
TEST_F(DrivingSwap, WhatStandsAtRestDoesSoAfterAnUndo) {
  Load("test/motor", "");
  ASSERT_TRUE(history_.Apply({ReplaceModule{"/demo/m", "test/esc"}}));
  ASSERT_TRUE(In().PublishByHand(internal::FillWith(AnyValue(1500.)), Port::Setter::kRule));
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(dynamic_cast<Input<double>&>(In()).Get(), 0);
}

TEST_F(DrivingSwap, ABlockHasASafeValueOfTheNewUnit) {
  shop_.Add<Defaulted>("test/defaulted");
  for (const bool is_in_force : {true, false}) {
    Load("test/defaulted", "");
    ASSERT_TRUE(In().Block());
    ASSERT_EQ(Safe(), 1500);
    if (!is_in_force) In().Unblock();
    EXPECT_EQ(bool(history_.Apply({ReplaceModule{"/demo/m", "test/servo"}})), !is_in_force);
    EXPECT_EQ(In().stop() != nullptr, is_in_force);
    EXPECT_EQ(bool(history_.Apply({ReplaceModule{"/demo/m", "test/motor"}})), is_in_force) << "from rad to m/s";
    EXPECT_TRUE(!is_in_force || dynamic_cast<Input<double>&>(In()).Get() == 0);
    EXPECT_EQ(In().is_blocked(), is_in_force);
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

}  // namespace
}  // namespace runnel::testing
