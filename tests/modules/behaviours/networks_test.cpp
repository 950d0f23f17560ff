// Random networks of fusions that run: what a network says and wants lies between those in it, and who is not active
// has no part in it.

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "modules/behaviours/fusion.h"
#include "plugins/behaviours/behaviour.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {
namespace {

using namespace std::chrono_literals;

constexpr double kRounding = 1e-9;

/// Wants what the test wants.
class Wanting final : public Behaviour {
 public:
  using Behaviour::Behaviour;
  ControlOutput<double> value{this, "value"};
  double wanted = 0, active = 0, content = 0;

 private:
  std::optional<Outcome> Behave(double activation) override {
    value.Set(wanted);
    return Outcome{std::min(activation, active), content};
  }
};

/// A tree of fusions over behaviours, of any shape.
class Network {
 public:
  explicit Network(std::mt19937& random) : random_(random) {
    app_ = &runtime_.Create<Group>(runtime_.root(), "app");
    std::vector<std::pair<Behaviour*, Port*>> level;
    for (int i = Whole(2, 8); i > 0; --i) {
      Wanting& leaf = runtime_.Create<Wanting>(*app_, "leaf" + std::to_string(i));
      Enable(leaf);
      EXPECT_TRUE(Runtime::Construct(leaf));
      leaves.push_back(&leaf);
      level.emplace_back(&leaf, &leaf.value.port);
    }
    while (level.size() > 1) level = Fused(level);
    root = dynamic_cast<FusionBehaviour*>(level.front().first);
    EXPECT_TRUE(runtime_.MakeReady(runtime_.root()));
    CreateThread(runtime_, "control", {.period = 10ms});
    scheduler_ =
        std::make_unique<Scheduler>(runtime_, SchedulerOptions{.clock = SchedulerOptions::ClockKind::kSimulated});
  }

  /// Long enough for values to come through from the leaves.
  void Run() { ASSERT_TRUE(scheduler_->RunUntil(runtime_.clock().Now() + 200ms)); }
  [[nodiscard]] double Activity() const { return Newest<runnel::Activity>(root->activity); }
  [[nodiscard]] double Rating() const { return Newest<TargetRating>(root->target_rating); }
  [[nodiscard]] double Value() const {
    double value = 0;
    root->out().VisitLatest([&](const void* newest, ValueTimes) { value = *static_cast<const double*>(newest); });
    return value;
  }
  double Signal() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  int Whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

  std::vector<Wanting*> leaves;
  FusionBehaviour* root = nullptr;

 private:
  template <typename T>
  static double Newest(const Port& port) {
    double value = 0;
    port.VisitLatest([&](const void* newest, ValueTimes) { value = static_cast<const T*>(newest)->value(); });
    return value;
  }
  static void Enable(Behaviour& behaviour) { ASSERT_TRUE(behaviour.stimulation_mode.Set(StimulationMode::kEnabled)); }
  std::vector<std::pair<Behaviour*, Port*>> Fused(const std::vector<std::pair<Behaviour*, Port*>>& level) {
    std::vector<std::pair<Behaviour*, Port*>> next;
    for (std::size_t i = 0; i < level.size();) {
      const std::size_t count = std::min(level.size() - i, static_cast<std::size_t>(Whole(2, 4)));
      auto& fusion = runtime_.Create<FusionBehaviour>(*app_, "fusion" + std::to_string(fusions_++));
      Enable(fusion);
      // Averages alone leave values between those that are fused; a winner's is one of them.
      const auto method = Whole(0, 1) == 0 ? FusionMethod::kWinnerTakesAll : FusionMethod::kWeightedAverage;
      EXPECT_TRUE(fusion.channels.Set(static_cast<std::uint32_t>(count)));
      EXPECT_TRUE(fusion.method.Set(method));
      EXPECT_TRUE(Runtime::Construct(fusion));
      for (std::size_t k = 0; k < count; ++k) {
        const auto& [behaviour, wish] = level[i + k];
        EXPECT_TRUE(fusion.Attach(k + 1, *behaviour, *wish));
      }
      next.emplace_back(&fusion, &fusion.out());
      i += count;
    }
    return next;
  }

  std::mt19937& random_;
  Runtime runtime_;
  Group* app_ = nullptr;
  std::unique_ptr<Scheduler> scheduler_;
  int fusions_ = 0;
};

TEST(RunningNetworkTest, LiesBetweenThoseInIt) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    Network network(random);
    double greatest = 0;
    std::vector<double> values, ratings;
    for (Wanting* leaf : network.leaves) {
      leaf->active = network.Signal();
      leaf->content = network.Signal();
      leaf->wanted = 20 * network.Signal() - 10;
      greatest = std::max(greatest, leaf->active);
      values.push_back(leaf->wanted);
      ratings.push_back(leaf->content);
    }
    network.Run();
    EXPECT_GT(network.Activity(), 0) << "values have come through";
    EXPECT_LE(network.Activity(), greatest + kRounding);
    EXPECT_GE(network.Rating(), std::ranges::min(ratings) - kRounding);
    EXPECT_LE(network.Rating(), std::ranges::max(ratings) + kRounding);
    EXPECT_GE(network.Value(), std::ranges::min(values) - kRounding);
    EXPECT_LE(network.Value(), std::ranges::max(values) + kRounding);
  }
}

TEST(RunningNetworkTest, WhoIsNotActiveHasNoPartInIt) {
  std::mt19937 random(8);
  for (int round = 0; round < 40; ++round) {
    Network network(random);
    for (Wanting* leaf : network.leaves) {
      leaf->active = network.Whole(0, 2) == 0 ? 0.0 : network.Signal();
      leaf->content = network.Signal();
      leaf->wanted = network.Signal();
    }
    network.leaves.front()->active = 0.5;
    network.Run();
    const double activity = network.Activity(), rating = network.Rating(), value = network.Value();
    // Below a fusion of which nobody is active, all count alike; above it, it has no part either.
    for (Wanting* leaf : network.leaves) {
      if (leaf->active > 0) continue;
      leaf->wanted = 1000;
      leaf->content = network.Signal();
    }
    network.Run();
    EXPECT_NEAR(network.Activity(), activity, kRounding);
    EXPECT_NEAR(network.Rating(), rating, kRounding);
    EXPECT_NEAR(network.Value(), value, kRounding);
  }
}

}  // namespace
}  // namespace runnel
