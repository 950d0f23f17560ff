#include "plugins/values/watched_port.h"

#include <array>

#include <gmock/gmock.h>

#include "core/lockfree/thread_epoch.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"

namespace runnel::test {

namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Optional;

class Source final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  void Update() override {}
};

class WatchedPortTest : public ::testing::Test {
 protected:
  /// What is shown; nothing if it is not new.
  std::optional<int> Look(WatchedPort& watched) {
    const EpochGuard guard;
    {
      const std::lock_guard lock(runtime.structure_mutex());
      const auto found = watched.Find(runtime);
      EXPECT_TRUE(found) << found.error().ToString();
    }
    std::optional<int> seen;
    count = watched.VisitIfNew([&](const void* value, Time) { seen = *static_cast<const int*>(value); });
    EXPECT_EQ(count.has_value(), seen.has_value());
    return seen;
  }

  Runtime runtime;
  Group& app = runtime.Create<Group>(runtime.root(), "app");
  Source& source = runtime.Create<Source>(app, "source");
  std::optional<std::uint64_t> count;
};

TEST_F(WatchedPortTest, ShowsEachValueOnce) {
  WatchedPort watched("/app/source/output/out");
  EXPECT_EQ(Look(watched), std::nullopt);  // there is none yet
  source.out.Publish(7);
  EXPECT_EQ(Look(watched), 7);
  EXPECT_EQ(count, 1U);
  EXPECT_EQ(Look(watched), std::nullopt);
  source.out.Publish(8);
  source.out.Publish(9);
  EXPECT_EQ(Look(watched), 9);
  EXPECT_EQ(count, 3U);
}

TEST_F(WatchedPortTest, FollowsAPortThatIsMadeAnew) {
  WatchedPort watched("/app/source/output/out");
  source.out.Publish(7);
  EXPECT_EQ(Look(watched), 7);
  ASSERT_TRUE(runtime.Delete(source));
  Source& again = runtime.Create<Source>(app, "source");
  EXPECT_EQ(Look(watched), std::nullopt);
  again.out.Publish(7);
  EXPECT_EQ(Look(watched), 7);  // the first again, and another one
  EXPECT_EQ(count, 1U);
}

Port::Fill FillWith(int value) {
  return [value](void* place) -> Result<void> {
    *static_cast<int*>(place) = value;
    return {};
  };
}

// Each has published as many values as the other.
TEST_F(WatchedPortTest, ShowsWhatIsSetByHandAndWhatIsReadAfterIt) {
  Input<int> in(app, "in");
  ASSERT_TRUE(Port::Connect(source.out, in));
  WatchedPort output("/app/source/output/out");
  WatchedPort input("/app/in");
  const auto look = [&] { return std::array{Look(output), Look(input)}; };
  source.out.Publish(1);
  EXPECT_THAT(look(), Each(Optional(1)));
  ASSERT_TRUE(source.out.PublishByHand(FillWith(42)));
  EXPECT_THAT(look(), Each(Optional(42)));
  EXPECT_THAT(look(), Each(std::nullopt));
  ASSERT_TRUE(source.out.Release());
  EXPECT_THAT(look(), Each(Optional(1)));
  ASSERT_TRUE(in.PublishByHand(FillWith(7)));
  EXPECT_EQ(Look(input), 7);
  ASSERT_TRUE(in.Release());
  ASSERT_TRUE(in.PublishByHand(FillWith(8)));
  EXPECT_EQ(Look(input), 8);
}

TEST_F(WatchedPortTest, ShowsTheSafeValueOfAnInputThatIsStopped) {
  Input<int> in(app, "in", {.drives = true, .command = DrivingKind::kPosition, .safe_value = AnyValue(-1)});
  ASSERT_TRUE(Port::Connect(source.out, in));
  WatchedPort input("/app/in");
  source.out.Publish(1);
  EXPECT_EQ(Look(input), 1);
  ASSERT_TRUE(runtime.robot_stop().Press("a test"));
  EXPECT_EQ(Look(input), -1);
  source.out.Publish(2);
  ASSERT_TRUE(runtime.robot_stop().Release("a test"));
  EXPECT_EQ(Look(input), -1);
  source.out.Publish(3);
  EXPECT_EQ(Look(input), 3);
}

// As its readers find it; and so does who looks behind it.
TEST_F(WatchedPortTest, ShowsTheSafeValueOfAnOutputThatIsStopped) {
  auto& border = runtime.Create<ProxyPort>(app, "border", Port::Direction::kOutput, TypeOf<int>());
  ASSERT_TRUE(Port::Connect(source.out, border));
  ASSERT_TRUE(source.out.SetDriving(true, AnyValue(-1), {}, DrivingKind::kEffort));
  WatchedPort output("/app/source/output/out");
  WatchedPort behind("/app/border");
  const auto look = [&] { return std::array{Look(output), Look(behind)}; };
  const auto shown = [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    int found = 0;
    EXPECT_TRUE(VisitShown(source.out, [&](const void* value, Time) { found = *static_cast<const int*>(value); }));
    return found;
  };
  ASSERT_TRUE(runtime.robot_stop().Press("a test"));
  EXPECT_THAT(look(), Each(Optional(-1))) << "before anything has been published";
  source.out.Publish(1);
  EXPECT_THAT(look(), Each(Optional(-1)));
  EXPECT_EQ(shown(), -1);
  ASSERT_TRUE(runtime.robot_stop().Release("a test"));
  EXPECT_THAT(look(), Each(Optional(-1))) << "what is from before the release does not count";
  source.out.Publish(2);
  EXPECT_THAT(look(), Each(Optional(2)));
  EXPECT_EQ(shown(), 2);
  ASSERT_TRUE(runtime.robot_stop().Press("a test"));
  EXPECT_THAT(look(), Each(Optional(-1))) << "at once, though nothing new is published";
}

TEST_F(WatchedPortTest, ShowsTheValueOfAnotherSource) {
  Source& other = runtime.Create<Source>(app, "other");
  Input<int> in(app, "in");
  ASSERT_TRUE(Port::Connect(source.out, in));
  source.out.Publish(1);
  other.out.Publish(2);
  WatchedPort input("/app/in");
  EXPECT_EQ(Look(input), 1);
  ASSERT_TRUE(Port::Disconnect(source.out, in));
  ASSERT_TRUE(Port::Connect(other.out, in));
  EXPECT_EQ(Look(input), 2);
}

TEST_F(WatchedPortTest, ShowsWhatComesThroughAPortOfAGroup) {
  auto& border = runtime.Create<ProxyPort>(app, "border", Port::Direction::kOutput, TypeOf<int>());
  ASSERT_TRUE(Port::Connect(source.out, border));
  WatchedPort watched("/app/border");
  source.out.Publish(5);
  EXPECT_EQ(Look(watched), 5);
  EXPECT_EQ(Look(watched), std::nullopt);
}

TEST_F(WatchedPortTest, WhatIsNotThereIsSaidWithTheNearest) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto missing = WatchedPort("/app/source/output/ouf").Find(runtime);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().hint, HasSubstr("out"));
  const auto no_port = WatchedPort("/app/source").Find(runtime);
  ASSERT_FALSE(no_port);
  EXPECT_THAT(no_port.error().message, HasSubstr("not a port"));
}

}  // namespace

}  // namespace runnel::test
