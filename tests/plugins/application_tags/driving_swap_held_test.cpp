// The same swaps, where the place is blocked, stands at rest or is set by hand, or the robot is stopped. What is read moves
// nothing that stood.

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "core/port/stand_in.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/driving_swap_variants.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;

enum class Held { kBlocked, kByRule, kByRuleAtSource, kByPersonWhoIsHeardOf, kByPerson, kStopped };
constexpr double kPublished = 0.7, kByHand = 0.4;

struct DrivingSwapHeld : TableOfVariants {
  Port& Source() { return shop->Get<Port>("/demo/s/output/value"); }
  double Read() { return Reader(*shop).Get(); }
  bool Hold(Held how) {
    Port& port = how == Held::kByRuleAtSource ? Source() : In(*shop);
    const auto rest = SafeValueOf(port);
    switch (how) {
      case Held::kBlocked:
        return bool(port.Block());
      case Held::kByRule:
      case Held::kByRuleAtSource:
        return rest && port.PublishByHand(internal::FillWith(*rest), Port::Setter::kRule);
      case Held::kByPersonWhoIsHeardOf:
        if (!rest || !port.PublishByHand(internal::FillWith(*rest))) return false;
        HandSlot::Of(port)->hold = std::make_unique<HandSlot::Hold>();
        HandSlot::Of(port)->hold->safe_value = *rest;
        return true;
      case Held::kByPerson:
        return bool(port.PublishByHand(internal::FillWith(AnyValue(kByHand))));
      case Held::kStopped:
        return true;
    }
    return false;
  }
  bool IsHeld(Held how) {
    switch (how) {
      case Held::kBlocked:
        return In(*shop).is_blocked();
      case Held::kByRule:
        return In(*shop).is_set_by_hand(Port::Setter::kRule);
      case Held::kByRuleAtSource:
        return Source().is_set_by_hand(Port::Setter::kRule);
      case Held::kByPersonWhoIsHeardOf:
      case Held::kByPerson:
        return In(*shop).is_set_by_hand();
      case Held::kStopped:
        return true;
    }
    return false;
  }
  void Swap(std::size_t variant, Held how);
};

void DrivingSwapHeld::Swap(std::size_t variant, Held how) {
  const double read = Read();
  const Stop stop = StopAt(*shop);
  const std::string unit = Reader(*shop).unit();
  const bool is_swapped = bool(history->Apply({ReplaceModule{"/demo/m", Name(variant)}}));
  EXPECT_TRUE(IsHeld(how));
  if (!is_swapped) {
    EXPECT_EQ(Read(), read) << "refused";
    return;
  }
  const Stop after = StopAt(*shop);
  // What is said of a composite is where it is at rest; what a part of it declares, where it is stopped.
  const auto own = In(*shop).stop();
  const double rest = own && own->robot() ? Number(own->safe_value()) : after.safe;
  const std::string other = Reader(*shop).unit();
  const bool is_position = DrivingKindByUnits(TypeOf<double>(), other) == DrivingKind::kPosition;
  if (how == Held::kStopped) shop->runtime.robot_stop().Press("a test");
  const double now = Read();
  const bool is_same = now == read && (unit == other || other.empty() || how == Held::kByPerson);
  const bool is_zero = now == 0 && !is_position;
  if (how == Held::kByPerson) {
    EXPECT_EQ(now, kByHand);
  } else if (how == Held::kStopped) {
    EXPECT_EQ(now, after.drives ? after.safe : kPublished);
  } else if (how == Held::kBlocked) {
    EXPECT_TRUE((after.drives && (now == after.safe || now == rest)) || is_same || is_zero) << now;
  } else {
    EXPECT_EQ(now, after.drives ? rest : 0);
  }
  const bool is_undone = bool(history->Undo());
  EXPECT_TRUE(IsHeld(how));
  if (how == Held::kStopped) {
    // What drove by nobody's word is stopped, too, or stays as it is.
    if (after.drives) {
      EXPECT_NE(Read(), kPublished);
      EXPECT_TRUE(!is_undone || !stop.drives || Read() == stop.safe) << Read();
    }
    EXPECT_TRUE(shop->runtime.robot_stop().Release("a test"));
    return;
  }
  if (is_undone) {
    EXPECT_EQ(Read(), read) << "undone";
    EXPECT_EQ(StopAt(*shop), stop);
    return;
  }
  EXPECT_TRUE(how == Held::kBlocked && !stop.drives && unit != other) << "not undone";
  EXPECT_EQ(Read(), now);
  In(*shop).Unblock();
  EXPECT_TRUE(history->Undo());
}

// The parameter is the module that is there first.
TEST_P(DrivingSwapHeld, MovesNothing) {
  for (const Held how : {Held::kBlocked, Held::kByRule, Held::kByRuleAtSource, Held::kByPersonWhoIsHeardOf,
                         Held::kByPerson, Held::kStopped}) {
    std::size_t first = int(how);  // each second module with one of the marks
    for (const std::string said :
         {"", " ", " safe=\"0\" command=\"velocity\"", " safe=\"1500\" command=\"velocity\""}) {
      for (std::size_t second = first++ % 4; second < kVariants && !HasFailure(); second += 4) {
        if (!Load(Name(GetParam()), said)) break;
        ASSERT_TRUE(Source().PublishFilled(internal::FillWith(AnyValue(kPublished))));
        SCOPED_TRACE(Name(GetParam()) + said + " -> " + Name(second) + ", held " + std::to_string(int(how)));
        if (Hold(how)) Swap(second, how);
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Of, DrivingSwapHeld, ::testing::Range<std::size_t>(0, kVariants));

}  // namespace
}  // namespace runnel::testing
