#include <memory>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/robot_stop.h"
#include "modules/flow/passing_module.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel::flow {
namespace {

using test::KeepsRealTime;
using test::ModuleRig;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace std::chrono_literals;

using List = std::vector<double>;

/// A type that travels in buffers, and cannot be copied.
struct Unique {
  Unique() = default;
  Unique(Unique&&) = default;
  Unique& operator=(Unique&&) = default;
  std::int32_t number = 0;
};
void Describe(TypeBuilder<Unique>& type) { type.Name("test_unique").Field("number", &Unique::number); }

/// All that has come since the last call.
template <typename T>
std::vector<T> Taken(Input<T>& input) {
  std::vector<T> values;
  input.Drain([&](const auto& each) { values.push_back(*each); });
  return values;
}

TEST(MuxTest, PassesWhatIsSelected) {
  ModuleRig<Mux> rig;
  rig.Set("inputs", "3");
  auto& out = rig.Follow(rig.output<double>("out"));
  rig.Feed("in1", 1.0);
  rig.Feed("in3", 3.0);
  rig.RunCycles(2);
  EXPECT_THAT(Taken(out), ElementsAre(1.0));
  rig.Set("selected", "3");
  rig.RunCycles(2);
  EXPECT_THAT(Taken(out), ElementsAre(3.0)) << "what is there passes at once, and once";
  rig.Set("selected", "1");
  rig.RunCycle();
  EXPECT_THAT(Taken(out), ElementsAre(1.0)) << "again";
  for (const char* none : {"0", "4"}) {
    rig.Set("selected", none);
    rig.Feed("in1", 4.0);
    rig.RunCycle();
    EXPECT_THAT(Taken(out), IsEmpty());
  }
}

TEST(MuxTest, ForwardsTheVeryValueWithItsTimestamp) {
  Runtime probe;
  Output<Unique> known(probe.root(), "makes_the_type_known");
  ModuleRig<Mux> rig;
  rig.Set("type", "test_unique");
  auto& out = rig.Follow(rig.output<Unique>("out"));
  auto& in = rig.input<Unique>("in1");
  Unique value;
  value.number = 7;
  const Time measured = rig.now();
  rig.Feed(in, std::move(value));
  rig.Wait(1s);
  rig.RunCycle();
  const auto passed = out.Take();
  EXPECT_EQ(&*passed, &*in.Peek());
  EXPECT_EQ(passed.timestamp(), measured);
  EXPECT_NE(passed.publication_time(), measured);
}

TEST(MuxTest, SaysWhichTypesThereAre) {
  ModuleRig<Mux> rig;
  rig.Set("type", "doubel");
  const auto prepared = rig.Prepare();
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().ToString(),
            "/module/parameter/type: there is no data type 'doubel'; did you mean 'double'?");
}

TEST(MergeTest, PassesWhatComesByAnyInput) {
  ModuleRig<Merge> rig;
  rig.Set("inputs", "3");
  rig.UseQueue("in2", 10);
  auto& out = rig.Follow(rig.output<double>("out"));
  rig.Feed("in3", 3.0);
  rig.Feed("in2", 2.1);
  rig.Feed("in2", 2.2);
  rig.Feed("in1", 0.0);
  rig.Feed("in1", 1.0);
  rig.RunCycles(2);
  EXPECT_THAT(Taken(out), ElementsAre(1.0, 2.1, 2.2, 3.0));
}

TEST(GateTest, PassesWhileItIsOpen) {
  ModuleRig<Gate> rig;
  rig.UseQueue("in", 10);
  auto& out = rig.Follow(rig.output<double>("out"));
  rig.Feed("in", 1.0);
  rig.Feed("in", 2.0);
  rig.RunCycle();
  EXPECT_THAT(Taken(out), ElementsAre(1.0, 2.0));
  rig.Set("open", "false");
  rig.Feed("in", 3.0);
  rig.RunCycle();
  rig.Feed("in", 4.0);
  rig.RunCycle();
  EXPECT_THAT(Taken(out), IsEmpty());
  rig.Set("open", "true");
  rig.RunCycles(2);
  EXPECT_THAT(Taken(out), ElementsAre(4.0));
}

TEST(SampleTest, PassesTheNewestNowAndThen) {
  ModuleRig<Sample> rig(10ms);
  rig.Set("period", "35ms");
  auto& out = rig.Follow(rig.output<double>("out"));
  for (int i = 0; i <= 14; ++i) {
    rig.Feed("in", double(i));
    rig.RunCycle();
  }
  EXPECT_THAT(Taken(out), ElementsAre(0, 4, 7, 11, 14)) << "35 ms on average";
  rig.RunCycles(10);
  EXPECT_THAT(Taken(out), IsEmpty());
  rig.Set("repeats", "true");
  rig.RunCycles(7);
  EXPECT_THAT(Taken(out), ElementsAre(14, 14));
}

TEST(DelayTest, PassesEachValueLater) {
  ModuleRig<Delay> rig(10ms);
  rig.Set("delay", "20ms");
  auto& out = rig.Follow(rig.output<double>("out"));
  rig.Feed("in", 1.0);
  rig.RunCycle();
  rig.Feed("in", 2.0);
  rig.RunCycle();
  EXPECT_THAT(Taken(out), IsEmpty());
  rig.RunCycle();
  EXPECT_THAT(Taken(out), ElementsAre(1.0));
  rig.RunCycle();
  EXPECT_THAT(Taken(out), ElementsAre(2.0));
}

TEST(DelayTest, LetsTheOldestPassWhereTooManyWait) {
  ModuleRig<Delay> rig(10ms);
  rig.Set("delay", "10 s");
  rig.Set("capacity", "2");
  rig.UseQueue("in", 10);
  auto& out = rig.Follow(rig.output<double>("out"));
  for (const double value : {1.0, 2.0, 3.0}) rig.Feed("in", value);
  rig.RunCycle();
  EXPECT_THAT(Taken(out), ElementsAre(1.0));
  rig.Set("delay", "0");
  rig.RunCycle();
  EXPECT_THAT(Taken(out), ElementsAre(2.0, 3.0));
}

/// Something moves by what passes; the module's input is marked, and STOP is pressed while it holds a value back.
template <typename M>
class StoppedPassing {
 public:
  StoppedPassing(const char* parameter, const char* value) : out(rig.template output<double>("out")) {
    rig.Set(parameter, value);
    EXPECT_TRUE(rig.Prepare());
    EXPECT_TRUE(rig.template input<double>("in").SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {},
                                                            DrivingKind::kEffort));
    Run(1);
    Run(2);
    EXPECT_TRUE(rig.runtime.robot_stop().Press("a test"));
    Run(3);
  }
  void Run(double fed) {
    rig.Feed("in", fed);
    rig.RunCycle();
  }
  void Release() {
    rig.Wait(10ms);
    EXPECT_TRUE(rig.runtime.robot_stop().Release("a test"));
    rig.Wait(10ms);
  }
  double Last() { return rig.Last(out); }

  ModuleRig<M> rig{10ms};
  Output<double>& out;
};

TEST(StopTest, ASafeValuePassesASampleAtOnce) {
  StoppedPassing<Sample> stopped("period", "5 s");
  EXPECT_EQ(stopped.Last(), -7);
  stopped.Release();
  stopped.Run(4);
  EXPECT_EQ(stopped.Last(), -7) << "the next one is not due yet";
  stopped.rig.Wait(5s);
  stopped.Run(5);
  EXPECT_EQ(stopped.Last(), 5);
}

TEST(StopTest, ASafeValuePassesAClosedGate) {
  StoppedPassing<Gate> stopped("open", "false");
  EXPECT_EQ(stopped.Last(), -7);
  stopped.Release();
  stopped.Run(4);
  EXPECT_EQ(stopped.Last(), -7) << "it is closed";
  stopped.rig.Set("open", "true");
  stopped.Run(5);
  EXPECT_EQ(stopped.Last(), 5);
}

TEST(StopTest, ASafeValueDoesNotWaitInADelayNorDoesWhatWasThere) {
  StoppedPassing<Delay> stopped("delay", "100ms");
  EXPECT_EQ(stopped.Last(), -7);
  stopped.rig.RunCycles(20);
  EXPECT_EQ(stopped.Last(), -7) << "what waited is gone";
  stopped.Release();
  stopped.Run(4);
  stopped.rig.RunCycles(5);
  EXPECT_EQ(stopped.Last(), -7);
  stopped.rig.RunCycles(10);
  EXPECT_EQ(stopped.Last(), 4);
}

TEST(StopTest, OfAQueueNothingOfBeforePasses) {
  ModuleRig<Gate> rig(10ms);
  rig.UseQueue("in", 10);
  rig.Feed("in", 1.0);
  rig.RunCycle();
  ASSERT_TRUE(rig.input<double>("in").SetDriving(true, {TypeOf<double>(), std::make_shared<double>(-7)}, {},
                                                 DrivingKind::kEffort));
  for (const double value : {2.0, 3.0}) rig.Feed("in", value);
  ASSERT_TRUE(rig.runtime.robot_stop().Press("a test"));
  auto& out = rig.Follow(rig.output<double>("out"));
  (void)Taken(out);
  rig.RunCycles(2);
  EXPECT_THAT(Taken(out), ElementsAre(-7, -7));
}

TEST(FlowTest, NeitherAllocatesNorLocks) {
  ModuleRig<Delay> rig(10ms);
  rig.Set("type", "string");
  rig.Set("delay", "20ms");
  for (int i = 0; i < 20; ++i) {
    rig.Feed("in", std::string("a text that is too long to lie in the string itself"));
    rig.RunCycle();
  }
  rig.Feed("in", std::string("another text that is too long to lie in the string itself"));
  EXPECT_THAT(rig, KeepsRealTime(4));
}

}  // namespace
}  // namespace runnel::flow
