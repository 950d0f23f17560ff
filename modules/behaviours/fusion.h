#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/port/typed_ports.h"
#include "core/types/type_info.h"
#include "modules/behaviours/algorithm/fusion.h"
#include "plugins/behaviours/behaviour.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

/// Values of one type made one: all numbers in them are weighted and added, those that are angles (unit rad) as unit
/// vectors; what is no number (a name, a truth value) is the winner's.
///
/// Allocation:  Make() only. Threads: one at a time.
class ValueFusion {
 public:
  /// For up to so many values of the type; `unit` of a type that is a number itself. Errors: the values have texts,
  /// lists of any length or what nobody may look at in them.
  static Result<ValueFusion> Make(const TypeInfo& type, const std::string& unit, std::size_t values);

  /// `values`: one for each weight; nullptr where the weight is 0. That of the winner is there.
  void Fuse(std::span<const double> weights, std::span<const void* const> values, std::size_t winner, void* fused);

 private:
  /// A number somewhere in the values, so many bytes behind their beginning: they have no parts elsewhere.
  struct Number {
    std::size_t offset;
    const TypeInfo* type;
    bool is_angle;
  };

  explicit ValueFusion(const TypeInfo& type) : type_(&type) {}
  /// The numbers in the part `at` of `value`.
  Result<void> AddNumbers(const TypeInfo& type, const std::string& unit, void* at, const void* value);

  const TypeInfo* type_;
  std::vector<Number> numbers_;
  std::vector<double> found_;
};

inline void Describe(TypeBuilder<FusionMethod>& type) {
  type.Name("FusionMethod")
      .Values<FusionMethod::kWinnerTakesAll, FusionMethod::kWeightedAverage, FusionMethod::kWeightedSum>();
}

/// Makes what several behaviours want one, by how active each is: the only way in which two of them may command one
/// actuator. Channel i has the ports activity<i>, target_rating<i> and in<i>.
///
/// Values:  of one type, `type`; the winner's is published on without a copy, others are weighted number by number,
///          angles as unit vectors (ValueFusion). A channel without activity need not have a value.
///          Where nobody is active, velocities are a standstill, and values of other types are not published.
/// Stamps:  the oldest of all activities, and of the values that have part in what is published.
/// Errors:  a type that no port of a loaded plugin has; a method that cannot weight values of the type.
class FusionBehaviour final : public Behaviour, public PreparesAnywhere {
 public:
  using Behaviour::Behaviour;
  static constexpr std::uint32_t kMostChannels = 1000;

  StaticParameter<std::string> type{
      this, "type", {.default_value = "double", .description = "of what the behaviours want"}};
  StaticParameter<std::uint32_t> channels{
      this, "channels", {.default_value = 2, .bounds = {1, kMostChannels}, .description = "how many behaviours"}};
  StaticParameter<std::string> unit{
      this, "unit", {.default_value = "", .description = "of numbers (type double …): rad makes them angles"}};
  Parameter<FusionMethod> method{
      this, "method", {.default_value = FusionMethod::kWeightedAverage, .description = "how they are made one"}};
  InputTimeout activity_timeout{this, "activity", {}};
  InputTimeout target_rating_timeout{this, "target_rating", {}};
  InputTimeout in_timeout{this, "in", {}};

  /// For composites written in C++: connects the three ports of a channel, the first is 1, with a behaviour and what it wants.
  /// After Construct(). Errors: there is no such channel; as Port::Connect().
  Result<void> Attach(std::size_t channel, Behaviour& behaviour, Port& wish);
  [[nodiscard]] ActivityNeeds Needs() const override;
  /// After Construct().
  [[nodiscard]] Port& out() const noexcept { return *output_; }

 private:
  // What is fused goes out when the rules hold, as that of other behaviours.
  class FusedValue final : public HeldBack {
   public:
    explicit FusedValue(FusionBehaviour& fusion) : HeldBack(fusion), fusion_(fusion) {}

   private:
    void Publish() override { fusion_.PublishFused(); }
    void Discard() override { fusion_.DiscardFused(); }
    FusionBehaviour& fusion_;
  };

  Result<void> Construct() override;
  Result<void> Prepare() override;
  std::optional<Outcome> Behave(double activation) override;
  void OnBehaviourParametersChanged() override;
  // Why they do not count; nullptr: they do. Of values those of the channels that are active.
  [[nodiscard]] const char* ReadSignals();
  [[nodiscard]] const char* ReadValues();
  void PublishFused();
  void DiscardFused();

  std::deque<Input<Activity>> activities_;
  std::deque<Input<TargetRating>> target_ratings_;
  std::vector<std::unique_ptr<Port>> inputs_;
  std::unique_ptr<Port> output_;
  std::unique_ptr<HeldValues> values_;
  FusedValue fused_{*this};
  std::optional<ValueFusion> value_fusion_;  // nothing: only the winner's can be taken
  std::string no_fusion_;                    // why
  std::shared_ptr<const void> standstill_;   // nullptr: zero of the type is none
  FusionMethod chosen_ = FusionMethod::kWinnerTakesAll;
  std::vector<FusedChannel> signals_;
  std::vector<double> weights_;
  std::vector<const void*> found_;
  std::size_t winner_ = 0;
  bool has_fused_ = false;
};

}  // namespace runnel
