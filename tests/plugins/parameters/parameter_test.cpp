#include "plugins/parameters/parameter.h"

#include <atomic>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "core/module/module.h"

namespace runnel {
namespace {

enum class Side { kLeft, kRight };
void Describe(TypeBuilder<Side>& type) { type.Name("Side").Value("left", Side::kLeft).Value("right", Side::kRight); }

// Its halves are always equal, so that a torn value shows.
struct Pair {
  double first = 0;
  double second = 0;
};
void Describe(TypeBuilder<Pair>& type) {
  type.Name("Pair").Field("first", &Pair::first).Field("second", &Pair::second);
}

class Guard final : public Module {
 public:
  using Module::Module;
  Parameter<double> stop_distance{this,
                                  "stop_distance",
                                  {.default_value = 0.3,
                                   .bounds = {0.05, 5.0},
                                   .unit = "m",
                                   .description = "obstacles nearer than this stop the robot"}};
  Parameter<std::int64_t> beams{this, "beams", {.default_value = 9, .bounds = {.lowest = 1}}};
  Parameter<bool> active{this, "active", {.default_value = true}};
  Parameter<Side> side{this, "side"};
  Parameter<Pair> pair{this, "pair"};
  StaticParameter<std::string> label{this, "label", {.default_value = "front"}};
  StaticParameter<std::vector<double>> weights{this, "weights"};
  StaticParameter<std::int32_t> size{this, "size", {.default_value = 4, .bounds = {.highest = 8}}};

 private:
  void Update() override {}
};

class ParameterTest : public ::testing::Test {
 protected:
  Runtime runtime_;
  Guard& guard_ = runtime_.Create<Guard>(runtime_.root(), "guard");
};

TEST_F(ParameterTest, HangsBelowItsModule) {
  EXPECT_EQ(guard_.stop_distance.path(), "/guard/parameter/stop_distance");
  EXPECT_EQ(guard_.stop_distance.kind(), ElementKind::kParameter);
}

TEST_F(ParameterTest, SaysWhatItIs) {
  const ConfigurableInfo& info = guard_.stop_distance.info();
  EXPECT_EQ(info.unit, "m");
  EXPECT_EQ(info.bounds, "0.05 .. 5");
  EXPECT_EQ(info.default_value, "0.3");
  EXPECT_EQ(info.description, "obstacles nearer than this stop the robot");
  EXPECT_FALSE(info.is_static);
  EXPECT_TRUE(guard_.label.info().is_static);
  EXPECT_EQ(info.minimum, 0.05);
  EXPECT_EQ(info.maximum, 5.0);
  EXPECT_EQ(guard_.beams.info().bounds, "1 ..");
  EXPECT_EQ(guard_.beams.info().minimum, 1.0);
  EXPECT_EQ(guard_.beams.info().maximum, std::nullopt);
  EXPECT_EQ(guard_.size.info().bounds, ".. 8");
  EXPECT_EQ(guard_.active.info().bounds, "");
  EXPECT_EQ(&guard_.side.type(), &TypeOf<Side>());
}

TEST_F(ParameterTest, HasItsDefaultAtFirst) {
  EXPECT_EQ(guard_.stop_distance.Get(), 0.3);
  EXPECT_TRUE(guard_.active.Get());
  EXPECT_EQ(guard_.side.Get(), Side::kLeft);
  EXPECT_EQ(guard_.label.Get(), "front");
  EXPECT_TRUE(guard_.weights.Get().empty());
}

TEST_F(ParameterTest, ReadsTheTextFormatOfAllKindsOfTypes) {
  EXPECT_TRUE(guard_.stop_distance.SetFromText("1.5"));
  EXPECT_EQ(guard_.stop_distance.Get(), 1.5);
  EXPECT_EQ(guard_.stop_distance.ToText(), "1.5");
  EXPECT_TRUE(guard_.active.SetFromText("false"));
  EXPECT_FALSE(guard_.active.Get());
  EXPECT_TRUE(guard_.side.SetFromText("right"));
  EXPECT_EQ(guard_.side.Get(), Side::kRight);
  EXPECT_TRUE(guard_.pair.SetFromText("{first: 1, second: 2}"));
  EXPECT_EQ(guard_.pair.Get().second, 2);
  EXPECT_TRUE(guard_.label.SetFromText("rear left"));
  EXPECT_EQ(guard_.label.Get(), "rear left");
  EXPECT_TRUE(guard_.weights.SetFromText("[1, 2.5]"));
  EXPECT_EQ(guard_.weights.ToText(), "[1, 2.5]");
}

TEST_F(ParameterTest, RefusesWhatIsOutOfBoundsAndKeepsItsValue) {
  const auto set = guard_.stop_distance.SetFromText("5.1");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().ToString(), "/guard/parameter/stop_distance: 5.1 m is out of bounds; allowed is 0.05 .. 5 m");
  EXPECT_EQ(guard_.stop_distance.Get(), 0.3);
  EXPECT_TRUE(guard_.stop_distance.SetFromText("5"));
  EXPECT_FALSE(guard_.stop_distance.SetFromText("nan"));
  EXPECT_FALSE(guard_.beams.SetFromText("0"));
  EXPECT_FALSE(guard_.size.SetFromText("9"));
  EXPECT_EQ(guard_.size.Get(), 4);
}

TEST_F(ParameterTest, RefusesWhatIsNoValueAndKeepsItsOwn) {
  EXPECT_FALSE(guard_.beams.SetFromText("2.5"));
  EXPECT_FALSE(guard_.beams.SetFromText(""));
  EXPECT_FALSE(guard_.pair.SetFromText("{first: 1, third: 2}"));
  EXPECT_EQ(guard_.pair.Get().first, 0);
  const auto side = guard_.side.SetFromText("rihgt");
  ASSERT_FALSE(side);
  EXPECT_EQ(side.error().hint, "did you mean 'right'?");
}

TEST_F(ParameterTest, ChecksWithoutSetting) {
  EXPECT_TRUE(guard_.stop_distance.CheckText("1"));
  EXPECT_FALSE(guard_.stop_distance.CheckText("100"));
  EXPECT_EQ(guard_.stop_distance.Get(), 0.3);
}

TEST_F(ParameterTest, CanBeSetWhileItsModuleIsReady) {
  ASSERT_TRUE(runtime_.MakeReady(guard_));
  EXPECT_TRUE(guard_.stop_distance.Set(0.5));
  EXPECT_EQ(guard_.stop_distance.Get(), 0.5);
  EXPECT_FALSE(guard_.stop_distance.Set(-0.5));
  EXPECT_EQ(guard_.stop_distance.Get(), 0.5);
}

TEST_F(ParameterTest, CannotBeSetAnyMoreIfStatic) {
  ASSERT_TRUE(guard_.label.SetFromText("rear"));
  ASSERT_TRUE(runtime_.MakeReady(guard_));
  const auto set = guard_.label.SetFromText("left");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().path, "/guard/parameter/label");
  EXPECT_EQ(set.error().hint, "set it in the application file, or have a change do it, which makes the module anew");
  EXPECT_EQ(guard_.label.Get(), "rear");
}

TEST_F(ParameterTest, TakesValuesOfItsTypeAsTheyAre) {
  // No text of so few digits is this number.
  const double third = 1.0 / 3;
  ASSERT_TRUE(guard_.stop_distance.Put({std::make_shared<const double>(third)}));
  EXPECT_EQ(guard_.stop_distance.Get(), third);
  EXPECT_EQ(*std::static_pointer_cast<double>(guard_.stop_distance.Value()), third);
  const double far = 7;
  const auto set = guard_.stop_distance.Put({std::make_shared<const double>(far)});
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().ToString(), "/guard/parameter/stop_distance: 7 m is out of bounds; allowed is 0.05 .. 5 m");
  const std::string label = "a\x01";
  EXPECT_EQ(guard_.label.Put({std::make_shared<const std::string>(label)}).error().message,
            "the value contains control character 0x01");
}

template <typename P>
class ModuleWith final : public Module {
 public:
  ModuleWith(const Placement& placement, ParameterOptions<double> options)
      : Module(placement), distance(this, "distance", std::move(options)) {}
  P distance;

 private:
  void Update() override {}
};

template <typename P>
std::string WhyNotMade(Runtime& runtime, ParameterOptions<double> options) {
  try {
    runtime.Create<ModuleWith<P>>(runtime.root(), "module", std::move(options));
  } catch (const ElementError& error) {
    return error.error().ToString();
  }
  return "it has been made";
}

TEST_F(ParameterTest, IsRefusedWithADefaultOutsideOfItsOwnBounds) {
  const ParameterOptions<double> forgotten{.bounds = {0.05, 5.0}, .unit = "m"};
  const std::string why = "/module/parameter/distance: its default, 0 m, is out of its bounds; they are 0.05 .. 5 m";
  EXPECT_EQ(WhyNotMade<Parameter<double>>(runtime_, forgotten), why);
  EXPECT_EQ(WhyNotMade<StaticParameter<double>>(runtime_, forgotten), why);
  EXPECT_EQ(runtime_.root().FindChild("module"), nullptr);
  EXPECT_EQ(WhyNotMade<Parameter<double>>(runtime_, {.default_value = 0.05, .bounds = {0.05, 5.0}}),
            "it has been made");
}

TEST_F(ParameterTest, IsNeverSeenHalfSet) {
  constexpr int kChanges = 20000;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (int i = 1; i <= kChanges; ++i) {
      const double half = i;
      (void)guard_.pair.Set({half, half});
    }
    done = true;
  });
  bool torn = false;
  double last = 0;
  bool went_back = false;
  do {
    const Pair pair = guard_.pair.Get();
    torn = torn || pair.first != pair.second;
    went_back = went_back || pair.first < last;
    last = pair.first;
  } while (!done);
  writer.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(went_back);
  EXPECT_EQ(guard_.pair.Get().first, kChanges);
}

}  // namespace
}  // namespace runnel
