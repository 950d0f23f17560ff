#include "plugins/parameters/input_timeout.h"

#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "core/module/module.h"
#include "core/port/output.h"
#include "plugins/testing/module_rig.h"

namespace runnel {

struct Sight {
  double value = 0;
  bool was_measured = true;
};
inline void Describe(TypeBuilder<Sight>& type) {
  type.Name("TestSight").Field("value", &Sight::value).Field("was_measured", &Sight::was_measured);
}
inline bool IsMeasured(const Sight& sight) { return sight.was_measured; }
inline bool IsFinite(const Sight& sight) { return std::isfinite(sight.value); }

namespace {

using test::ModuleRig;
using testing::ElementsAre;

class Watcher final : public Module {
 public:
  explicit Watcher(const Placement& placement) : Module(placement) {
    for (const char* name : {"in1", "in2"}) ins.emplace_back(this, name, Measured("one of two"));
  }
  Input<Sight> sight{this, "sight", Measured("what is seen")};
  std::deque<Input<double>> ins;
  InputTimeout sight_timeout{this, sight, {.log = &log()}};
  InputTimeout in_timeout{this, "in", {}};
  bool saw = false;
  std::vector<bool> came{false, false};
  std::vector<std::string> said{"", ""};

 private:
  Result<void> Construct() override {
    values_ = FindTypedPorts(TypeOf<double>())->MakeHeldValues(2);
    return {};
  }
  void Update() override {
    saw = sight_timeout.Read(sight, now()).has_value();
    for (std::size_t i = 0; i < 2; ++i) {
      (void)in_timeout.Read(ins[i], *values_, i);
      came[i] = values_->Find(i) != nullptr;
      said[i] = in_timeout.words();
    }
  }
  std::unique_ptr<HeldValues> values_;
};

struct InputTimeoutTest : testing::Test {
  ModuleRig<Watcher> rig;  // cycles of 50 ms
  std::vector<std::string> told;
  LogSink sink{rig.runtime, [this](const LogMessage& message) { told.push_back(message.text); }};

  // What has been told since.
  std::vector<std::string> AfterCycles(std::uint64_t count) {
    FlushLog();
    told.clear();
    rig.RunCycles(count);
    FlushLog();
    return told;
  }
};

TEST_F(InputTimeoutTest, SaysOnceWhyAValueDoesNotCount) {
  EXPECT_THAT(AfterCycles(11), ElementsAre()) << "it may still come";
  EXPECT_THAT(AfterCycles(5), ElementsAre("sight has never come"));
  rig.Feed(rig.module.sight, {1.0});
  EXPECT_THAT(AfterCycles(5), ElementsAre("sight is there again"));
  EXPECT_TRUE(rig.module.saw);
  EXPECT_THAT(AfterCycles(10), ElementsAre("sight is old"));
  EXPECT_FALSE(rig.module.saw);
  rig.Feed(rig.module.sight, {1.0, false});
  EXPECT_THAT(AfterCycles(2), ElementsAre("sight is not measured"));
  EXPECT_FALSE(rig.module.saw);
  rig.Feed(rig.module.sight, {std::numeric_limits<double>::quiet_NaN()});
  EXPECT_THAT(AfterCycles(2), ElementsAre("sight is not a number"));
  EXPECT_FALSE(rig.module.saw);
}

TEST_F(InputTimeoutTest, IsAParameter) {
  rig.Set("sight_timeout", "2");
  rig.Feed(rig.module.sight, {1.0});
  rig.RunCycles(40);
  EXPECT_TRUE(rig.module.saw);
  rig.RunCycles(2);
  EXPECT_FALSE(rig.module.saw);
}

TEST_F(InputTimeoutTest, InputsThatAreNumberedHaveOneAndAnyType) {
  rig.Feed(rig.module.ins[1], 1.0);
  rig.RunCycle();
  EXPECT_THAT(rig.module.came, ElementsAre(false, true));
  EXPECT_THAT(rig.module.said, ElementsAre("in has never come", "in is there again"));
  rig.RunCycles(12);
  EXPECT_THAT(rig.module.came, ElementsAre(false, false));
  EXPECT_EQ(rig.module.said[1], "in is old");
  rig.Set("in_timeout", "3600");
  rig.RunCycle();
  EXPECT_THAT(rig.module.came, ElementsAre(false, true));
}

}  // namespace
}  // namespace runnel
