#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/port/output.h"
#include "plugins/real_time_check/real_time_watch.h"
#include "plugins/scheduling/fault.h"
#include "plugins/testing/module_rig.h"

namespace runnel::test {

/// Runs so many cycles, and returns what the module has done in them that it should not: allocating, locking, calling
/// the system. Run a few before, in which pools of buffers find their size. Under a sanitizer nothing is noticed.
///
/// The program that uses this has its malloc and its locks replaced, see plugins/real_time_check.
template <typename Rig>
[[nodiscard]] std::vector<RealTimeBreach> RunWatched(Rig& rig, std::uint64_t cycles) {
  struct Watching {
    ~Watching() { rig.SetWatch(nullptr); }
    Rig& rig;
  };
  RealTimeWatch watch(*RunnelRealTimeHooks());
  const Watching until_the_end{rig};
  rig.SetWatch(&watch);
  rig.RunCycles(cycles);
  std::vector<RealTimeBreach> all;
  for (const RealTimeBreaches& of_task : watch.Breaches()) {
    all.insert(all.end(), of_task.breaches.begin(), of_task.breaches.end());
  }
  return all;
}

/// What an output has published last is as `value` says:
///
///     EXPECT_THAT(rig.module.twist, HasPublished(Twist2{.turn = 1}));
///     EXPECT_THAT(rig.output<double>("sum"), HasPublished(Gt(2)));
template <typename Value>
class HasPublishedMatcher {
 public:
  using is_gtest_matcher = void;
  explicit HasPublishedMatcher(Value value) : value_(std::move(value)) {}

  template <typename T>
  bool MatchAndExplain(const Output<T>& output, std::ostream* explanation) const {
    bool matches = false;
    const bool has_any = output.VisitLatest([&](const void* newest, Time) {
      const T& published = *static_cast<const T*>(newest);
      const auto matcher = ::testing::SafeMatcherCast<const T&>(value_);
      if (explanation != nullptr) *explanation << "whose last is " << ::testing::PrintToString(published);
      matches = matcher.Matches(published);
    });
    if (!has_any && explanation != nullptr) *explanation << "that has published nothing";
    return matches;
  }
  void DescribeTo(std::ostream* text) const { *text << "has published what is wanted"; }
  void DescribeNegationTo(std::ostream* text) const { *text << "has not published what is not wanted"; }

 private:
  const Value value_;
};
template <typename Value>
[[nodiscard]] auto HasPublished(Value value) {
  return HasPublishedMatcher<Value>(std::move(value));
}

namespace internal {

/// A matcher that runs cycles of a rig. GoogleTest asks one that does not match twice, the second time for the
/// explanation: that one is kept from the first.
template <typename Run>
class CyclesMatcher {
 public:
  using is_gtest_matcher = void;
  CyclesMatcher(std::string description, Run run) : description_(std::move(description)), run_(std::move(run)) {}

  bool MatchAndExplain(const ModuleRigBase& rig, std::ostream* explanation) const {
    std::optional<std::string>& kept = *why_not_;
    const bool is_asked_again = explanation != nullptr && kept.has_value();
    const std::optional<std::string> why_not = is_asked_again ? std::exchange(kept, {}) : run_(rig.changeable());
    if (!is_asked_again) kept = why_not;
    if (why_not && explanation != nullptr) *explanation << *why_not;
    return !why_not;
  }
  void DescribeTo(std::ostream* text) const { *text << description_; }
  void DescribeNegationTo(std::ostream* text) const { *text << "not: " << description_; }

 private:
  const std::string description_;
  const Run run_;  // what is wrong; nullopt: nothing
  std::shared_ptr<std::optional<std::string>> why_not_ = std::make_shared<std::optional<std::string>>();
};

}  // namespace internal

/// Runs the rig until a cycle publishes such a value, for so many cycles at most. Of several that one cycle
/// publishes the last counts.
///
///     EXPECT_THAT(rig, PublishesWithin(5, rig.module.twist, Field(&Twist2::turn, Gt(0))));
template <typename T, typename Value>
[[nodiscard]] auto PublishesWithin(std::uint64_t cycles, const Output<T>& output, Value value) {
  return internal::CyclesMatcher("publishes what is wanted within " + std::to_string(cycles) + " cycles",
                                 [cycles, &output, value](ModuleRigBase& rig) -> std::optional<std::string> {
                                   const HasPublishedMatcher<Value> matcher(value);
                                   for (std::uint64_t i = 0; i < cycles; ++i) {
                                     const std::uint64_t before = output.publications();
                                     rig.RunCycle();
                                     if (output.publications() > before && matcher.MatchAndExplain(output, nullptr))
                                       return {};
                                   }
                                   std::ostringstream why_not;
                                   matcher.MatchAndExplain(output, &why_not);
                                   return "with an output " + why_not.str();
                                 });
}

/// What a fault says:  EXPECT_THAT(rig.RunUntilFault(), Optional(FaultSays(HasSubstr("out of range"))));
template <typename Text>
[[nodiscard]] auto FaultSays(Text text) {
  return ::testing::Field("message", &Fault::message, std::move(text));
}

/// Runs so many cycles, in none of which the module allocates, locks, or calls the system.
///
///     rig.RunCycles(20);  // pools of buffers find their size
///     EXPECT_THAT(rig, KeepsRealTime(100));
[[nodiscard]] inline auto KeepsRealTime(std::uint64_t cycles) {
  return internal::CyclesMatcher(
      "allocates, locks and calls the system in none of " + std::to_string(cycles) + " cycles",
      [cycles](ModuleRigBase& rig) -> std::optional<std::string> {
        std::string why_not;
        for (const RealTimeBreach& each : RunWatched(rig, cycles)) why_not += "\n" + each.ToString();
        return why_not.empty() ? std::nullopt : std::optional(why_not);
      });
}

}  // namespace runnel::test
