// What is connected to a module that is swapped is converted as before, or the swap is refused.

#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/driving_swap_fixture.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;
using ::testing::HasSubstr;

template <int kUnit>
struct SourceInUnit final : Module {
  using Module::Module;
  static constexpr const char* kUnits[] = {"km/h", "deg"};
  Output<double> value{this, "value", {.unit = kUnits[kUnit]}};
  void Update() override {}
};
struct Arm final : Module {
  using Module::Module;
  Input<double> in{this, "in", {.unit = "rad", .drives = true, .safe_value = AnyValue(0.3)}};
  void Update() override {}
};
struct DrivingSwapUnits : DrivingSwap {
  DrivingSwapUnits() {
    shop_.Add<Boxed>("test/boxed");
    shop_.Add<BoxOf<Undeclared<0>>>("test/boxed_number");
    shop_.Add<SourceInUnit<0>>("test/kilometres");
    shop_.Add<SourceInUnit<1>>("test/degrees");
    shop_.Add<Arm>("test/arm");
  }
  ChangeOutcome Swap(const char* type) { return history_.Apply({ReplaceModule{"/demo/m", type}}); }
};

// A file would connect them without.
TEST_F(DrivingSwapUnits, WhatIsConnectedIsConvertedAsAFileWouldConnectIt) {
  constexpr const char* kSays =
      "the values between /demo/s/output/value and /demo/m/input/in would be converted otherwise; disconnect them "
      "first";
  struct Trial {
    const char *first, *source, *second;
  };
  for (const Trial& each : {Trial{"test/motor", "test/kilometres", "test/boxed"},
                            {"test/boxed_number", "test/kilometres", "test/motor"},
                            {"test/motor", "test/kilometres", "test/number"},
                            {"test/number", "test/degrees", "test/servo"}}) {
    SCOPED_TRACE(std::string(each.first) + " -> " + each.second);
    Load(each.first, "", each.source);
    const auto refused = Swap(each.second);
    EXPECT_FALSE(refused);
    if (each.first != std::string("test/boxed_number")) {
      EXPECT_THAT(refused.diagnostics.ToString(), HasSubstr(kSays));
    }
    ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  }
}

// By what is connected when all of the set is done.
TEST_F(DrivingSwapUnits, WhatIsConnectedInTheSameSetCounts) {
  struct Metres final : Module {
    using Module::Module;
    Input<double> in{this, "in", {.unit = "m/s", .drives = true}};
    void Update() override {}
  };
  shop_.Add<Metres>("test/metres");
  Load("test/metres", "", "test/kilometres");
  const ReplaceModule swap{"/demo/m", "test/number"};
  const DisconnectPorts disconnect{"/demo/s/value", "/demo/m/in"};
  const ConnectPorts connect{"/demo/s/value", "/demo/m/in"};
  EXPECT_FALSE(history_.Apply({swap}));
  ASSERT_TRUE(history_.Apply({disconnect, swap, connect}));
  EXPECT_TRUE(In().is_driving()) << "as the one before";
  EXPECT_EQ(ReadUnderStop(), 0);
  ASSERT_TRUE(shop_.runtime.robot_stop().Release("a test"));
  ASSERT_TRUE(history_.Apply({DeleteElement{"/demo"}}));
  Load("test/number", "");
  constexpr const char* kSays = "would be converted otherwise; disconnect them first";
  for (const ChangeSet& each :
       {ChangeSet{disconnect, CreateModule{"/demo/t", "test/degrees"}, ConnectPorts{"/demo/t/value", "/demo/m/in"},
                  ReplaceModule{"/demo/m", "test/servo"}},
        ChangeSet{ReplaceModule{"/demo/s", "test/degrees"}, ReplaceModule{"/demo/m", "test/servo"}},
        ChangeSet{ReplaceModule{"/demo/m", "test/servo"}, ReplaceModule{"/demo/s", "test/degrees"}}}) {
    EXPECT_THAT(history_.Apply(each).diagnostics.ToString(), HasSubstr(kSays));
  }
}

TEST_F(DrivingSwapUnits, ASafeValueBehindAnotherUnitIsNone) {
  Load("test/arm", "", "test/degrees");
  EXPECT_FALSE(SafeValueOf(shop_.Get<Port>("/demo/s/output/value")));
  EXPECT_EQ(Number(*SafeValueOf(In())), 0.3);
}

}  // namespace
}  // namespace runnel::testing
