#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/plugins/application_tags/made_again_fixture.h"

namespace runnel::testing {

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

struct Fixed final : Module {
  using Module::Module;
  StaticParameter<double> gain{this, "gain", {.default_value = 1.0}};
  void Update() override {}
};
struct FixedHigh final : Module {
  using Module::Module;
  StaticParameter<double> gain{this, "gain", {.default_value = 1.0, .bounds = {0.5, 10.0}}};
  void Update() override {}
};
/// Its gain stands for one that stands for one.
struct Inner final : Group {
  using Group::Group;
  Result<void> Construct() override {
    runtime().Create<ByOne>(*this, "part");
    runtime().Create<GroupParameter>(*this, "gain", std::vector<std::string>{"part/gain"});
    return {};
  }
};
struct Nested final : Group {
  using Group::Group;
  Result<void> Construct() override {
    runtime().Create<Inner>(*this, "inner");
    runtime().Create<GroupParameter>(*this, "gain", std::vector<std::string>{"inner/gain"});
    return {};
  }
};
/// Its gain stands for one beside it.
struct Beside final : Group {
  using Group::Group;
  Result<void> Construct() override {
    runtime().Create<GroupParameter>(*this, "gain", std::vector<std::string>{"/demo/third/gain"});
    return {};
  }
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
    workshop_.Add<Fixed>("test/fixed");
    workshop_.Add<FixedHigh>("test/fixed_high");
    workshop_.Add<Nested>("test/nested");
    workshop_.Add<Beside>("test/beside");
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
class ValuesOfComposites : public ValuesOfOtherTypes {};

}  // namespace runnel::testing
