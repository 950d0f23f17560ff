#include "plugins/behaviours/meta_signal.h"

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"

namespace runnel {
namespace {

using ::testing::HasSubstr;

TEST(MetaSignalTest, IsWithinZeroAndOne) {
  EXPECT_EQ(Activity(0.25).value(), 0.25);
  EXPECT_EQ(Activity().value(), 0.0);
  EXPECT_THROW(Activity(1.01), std::out_of_range);
  EXPECT_THROW(Stimulation(-0.01), std::out_of_range);
  EXPECT_EQ(TextOf(TargetRating(0.5)), "{value: 0.5}");
}

struct MetaConnectionTest : ::testing::Test {
  MetaConnectionTest() { RegisterMetaSignals(); }

  template <typename From, typename To>
  bool MayConnect() {
    const std::string number = std::to_string(++count);
    Output<From> from(outputs, "out" + number);
    Input<To> to(inputs, "in" + number);
    const auto connected = Port::Connect(from, to);
    last_error = connected ? "" : connected.error().ToString();
    return connected.has_value();
  }

  Runtime runtime;
  Group& outputs = runtime.Create<Group>(runtime.root(), "outputs");
  Group& inputs = runtime.Create<Group>(runtime.root(), "inputs");
  int count = 0;
  std::string last_error;
};

TEST_F(MetaConnectionTest, OnlyTheLikeAndActivitiesStimulateAndInhibit) {
  EXPECT_TRUE((MayConnect<Stimulation, Stimulation>())) << last_error;
  EXPECT_TRUE((MayConnect<Inhibition, Inhibition>())) << last_error;
  EXPECT_TRUE((MayConnect<Activity, Stimulation>())) << last_error;
  EXPECT_TRUE((MayConnect<Activity, Inhibition>())) << last_error;
  EXPECT_TRUE((MayConnect<Activity, Activity>())) << last_error;
  EXPECT_TRUE((MayConnect<Activity, double>())) << last_error;
  EXPECT_TRUE((MayConnect<TargetRating, double>())) << last_error;
  EXPECT_FALSE((MayConnect<TargetRating, Inhibition>()));
  EXPECT_THAT(last_error, HasSubstr("TargetRating"));
  EXPECT_THAT(last_error, HasSubstr("Inhibition"));
  EXPECT_FALSE((MayConnect<TargetRating, Stimulation>()));
  EXPECT_FALSE((MayConnect<Inhibition, Stimulation>()));
  EXPECT_FALSE((MayConnect<Stimulation, Inhibition>()));
  EXPECT_FALSE((MayConnect<Stimulation, Activity>()));
  EXPECT_FALSE((MayConnect<double, Stimulation>()));
  EXPECT_FALSE((MayConnect<double, Activity>()));
  EXPECT_FALSE((MayConnect<Activity, TargetRating>()));
}

TEST_F(MetaConnectionTest, AnActivityInhibitsThroughTheInterfacesOfGroups) {
  auto& a = runtime.Create<Group>(outputs, "a");
  auto& b = runtime.Create<Group>(inputs, "b");
  auto& out = runtime.Create<ProxyPort>(a, "activity", Port::Direction::kOutput, TypeOf<Activity>());
  auto& in = runtime.Create<ProxyPort>(b, "inhibition", Port::Direction::kInput, TypeOf<Inhibition>());
  Output<Activity> from(a, "from");
  Input<Inhibition> to(b, "to");
  ASSERT_TRUE(Port::Connect(from, out));
  ASSERT_TRUE(Port::Connect(out, in));
  ASSERT_TRUE(Port::Connect(in, to));
  from.Publish(Activity(0.75));
  EXPECT_EQ(to.Get().value(), 0.75);
}

}  // namespace
}  // namespace runnel
