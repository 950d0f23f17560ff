// Values of parameters where a module of another type takes the place, which has other bounds, defaults, types, units or parts,
// and where that is taken back.

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "tests/plugins/application_tags/made_again_fixture.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

/// A gain of another kind each.
template <typename T, int kDefault>
struct WithGain : Module {
  explicit WithGain(const Placement& placement, ParameterOptions<T> options = {.default_value = kDefault})
      : Module(placement), gain{this, "gain", std::move(options)} {}
  Parameter<T> gain;
  void Update() override {}
};
using ByOne = WithGain<double, 1>;
using ByNothing = WithGain<double, 0>;
using ByFive = WithGain<double, 5>;
using Coarse = WithGain<float, 1>;
/// Does not take 0.
struct High final : WithGain<double, 1> {
  explicit High(const Placement& placement) : WithGain(placement, {.default_value = 1, .bounds = {0.5, 10.0}}) {}
  static inline bool throws = false;
  void Update() override {
    if (throws) throw std::runtime_error("no");
  }
};
struct InMetres final : WithGain<double, 0> {
  explicit InMetres(const Placement& placement)
      : WithGain(placement, {.default_value = 0, .bounds = {0.0, 0.007}, .unit = "m"}) {}
};
struct InCentimetres final : WithGain<double, 1> {
  explicit InCentimetres(const Placement& placement) : WithGain(placement, {.default_value = 1, .unit = "cm"}) {}
};
/// "gain" stands for both parts, "second" for one.
struct Parts : Group {
  Parts(const Placement& placement, std::string first, std::string second)
      : Group(placement), first_(std::move(first)), second_(std::move(second)) {}
  Result<void> Construct() override {
    for (const std::string& part : {first_, second_}) runtime().Create<ByOne>(*this, part);
    runtime().Create<GroupParameter>(*this, "gain", std::vector<std::string>{first_ + "/gain", second_ + "/gain"});
    runtime().Create<GroupParameter>(*this, "second", std::vector<std::string>{second_ + "/gain"});
    return {};
  }

 private:
  const std::string first_, second_;
};
struct LeftAndRight final : Parts {
  explicit LeftAndRight(const Placement& placement) : Parts(placement, "left", "right") {}
};
struct FrontAndRear final : Parts {
  explicit FrontAndRear(const Placement& placement) : Parts(placement, "front", "rear") {}
};

class ValuesOfOtherTypes : public MadeAgain {
 protected:
  ValuesOfOtherTypes() {
    workshop_.Add<ByOne>("test/one");
    workshop_.Add<ByNothing>("test/none");
    workshop_.Add<ByFive>("test/five");
    workshop_.Add<Coarse>("test/coarse");
    workshop_.Add<High>("test/high");
    workshop_.Add<InMetres>("test/metres");
    workshop_.Add<InCentimetres>("test/centimetres");
    workshop_.Add<LeftAndRight>("test/left_and_right");
    workshop_.Add<FrontAndRear>("test/front_and_rear");
    High::throws = false;
  }
  void StartWith(const std::string& type, const std::string& fed = "") {
    Start(R"(<module name="other" type="test/)" + type + R"(" thread="control"/>)" +
          (fed.empty() ? "" : R"(<connect from="source/value" to="other/)" + fed + R"("/>)"));
  }
  void Set(const std::string& value) { Do({SetParameter{"/demo/other/gain", value}}); }
  void Swap(const std::string& type, const std::vector<Setting>& settings = {}, std::uint64_t trial = 0) {
    const ChangeOutcome swapped = history_->Apply({ReplaceModule{"/demo/other", "test/" + type, settings, trial}});
    EXPECT_TRUE(swapped) << swapped.diagnostics.ToString();
  }
  // What is said of it.
  std::string Undo() {
    const ChangeOutcome undone = history_->Undo();
    EXPECT_TRUE(undone) << undone.diagnostics.ToString();
    return undone.diagnostics.ToString();
  }
  double Rear() { return Run("/demo/other/rear/parameter/gain"); }
};

TEST_F(ValuesOfOtherTypes, AreNotLostWhereTheOneOnTrialRefusesThem) {
  StartWith("one", "gain");
  Set("5");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Swap("high", {{"gain", "7"}}, 1000);
  EXPECT_EQ(Run(), 7);
  High::throws = true;
  Run();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, AreNotLostWhereAnUndoIsOnTrialAndRefusesThem) {
  StartWith("high", "gain");
  Set("5");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Swap("one", {}, 1000);
  ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
  EXPECT_EQ(Run(), 0);
  EXPECT_THAT(Undo(), HasSubstr("its value is not taken over: 0 is out of bounds"));
  EXPECT_EQ(Run(), 5);
  High::throws = true;
  Run();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ComeBackWhereTheOneBetweenHasRefusedThem) {
  StartWith("one", "gain");
  Set("5");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Swap("high", {{"gain", "7"}});
  EXPECT_EQ(Run(), 7);
  Undo();
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ComeBackByARedoWhereTheUndoHasRefusedThem) {
  StartWith("high", "gain");
  Set("5");
  Say(2);
  EXPECT_EQ(Run(), 2);
  Swap("one");
  Say(0);
  EXPECT_EQ(Run(), 0);
  Undo();
  EXPECT_EQ(Run(), 5);
  ASSERT_TRUE(history_->Redo());
  EXPECT_EQ(Run(), 0);
}

TEST_F(ValuesOfOtherTypes, ComeBackThoughTheyAreDefaultsOfTheOneBetween) {
  StartWith("one");
  Set("0");
  Swap("none");
  Undo();
  EXPECT_EQ(Run(), 0);
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "0");
  Set("6");
  Swap("none");
  EXPECT_EQ(Run(), 6);
  Set("0");
  Undo();
  EXPECT_EQ(Run(), 0) << "a person has set it since";
}

TEST_F(ValuesOfOtherTypes, AreNotTheDefaultsOfTheOneBetween) {
  StartWith("one", "gain");
  Swap("five");
  EXPECT_EQ(Run(), 5);
  Say(2);
  EXPECT_EQ(Run(), 2);
  Undo();
  EXPECT_EQ(Run(), 2);
  EXPECT_EQ(SavedValue("/demo/other/parameter/gain"), "1");
  Set("1");
  Swap("five");
  EXPECT_EQ(Run(), 1) << "a person has set it";
}

TEST_F(ValuesOfOtherTypes, ComeBackWithAllTheirDigits) {
  StartWith("one");
  Set("0.123456789");
  Swap("coarse");
  Undo();
  EXPECT_EQ(Run(), 0.123456789);
}

TEST_F(ValuesOfOtherTypes, ComeBackWithinTheirBounds) {
  StartWith("metres");
  Set("0.007");
  Swap("centimetres");
  Undo();
  EXPECT_EQ(Run(), 0.007);
}

TEST_F(ValuesOfOtherTypes, OfACompositeAreNotOlderThanWhatAnOutputHasGivenSince) {
  StartWith("front_and_rear");
  Set("5");
  Swap("one", {{"gain", "7"}});
  Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}});
  for (const double value : {2.0, 0.0}) {
    Say(value);
    EXPECT_EQ(Run(), value);
  }
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/gain"}});
  Set("8");
  EXPECT_EQ(Run(), 8);
  Undo();
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 0);
  EXPECT_EQ(Rear(), 0);
}

TEST_F(ValuesOfOtherTypes, OfOnePartAreNotThoseOfAnotherThatSomethingElseStandsFor) {
  StartWith("left_and_right", "left/gain");
  Say(2);
  Run();
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/left/gain"}});
  Do({SetParameter{"/demo/other/right/gain", "0"}});
  Swap("front_and_rear");
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 2);
  EXPECT_EQ(Rear(), 0);
  Undo();
  EXPECT_EQ(Run("/demo/other/left/parameter/gain"), 2);
  EXPECT_EQ(Run("/demo/other/right/parameter/gain"), 0);
}

TEST_F(ValuesOfOtherTypes, OfEachPartComeBackFromOneThatHasOneForAll) {
  StartWith("front_and_rear", "front/gain");
  Do({SetParameter{"/demo/other/rear/gain", "0"}});
  Say(2);
  Run();
  Do({DisconnectPorts{"/demo/source/value", "/demo/other/front/gain"}});
  Swap("one");
  EXPECT_EQ(Run(), 2);
  Undo();
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 2);
  EXPECT_EQ(Rear(), 0);
  ASSERT_TRUE(history_->Redo());
  Set("8");
  ASSERT_TRUE(history_->Undo());
  EXPECT_EQ(Run("/demo/other/front/parameter/gain"), 8);
  EXPECT_EQ(Rear(), 8);
}

}  // namespace
}  // namespace runnel::testing
