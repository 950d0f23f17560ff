#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/type_of.h"
#include "plugins/behaviours/algorithm/behaviour_rules.h"
#include "plugins/behaviours/meta_signal.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

class Behaviour;

/// Something that a behaviour publishes only once its meta signals have been found to keep the rules.
class HeldBack {
 public:
  virtual ~HeldBack() = default;
  HeldBack(const HeldBack&) = delete;
  HeldBack& operator=(const HeldBack&) = delete;

 protected:
  explicit HeldBack(Behaviour& behaviour);

 private:
  friend class Behaviour;
  /// What has been set since the last call.
  virtual void Publish() = 0;
  virtual void Discard() = 0;
};

/// An output of a behaviour: what Behave() sets is published when the rules hold, and not at all when they do not.
///
///     ControlOutput<Twist2> twist{this, "twist"};
///     …
///     twist.Set({.forward = 0.3});
///
/// Ownership:   a member of its behaviour, as other ports are.
/// Threads:     as Output. Allocation: as Output.
template <typename T>
class ControlOutput final : public HeldBack {
 public:
  template <typename SomeBehaviour>
  ControlOutput(SomeBehaviour* behaviour, std::string name, OutputOptions options = {})
      : HeldBack(*behaviour), port(behaviour, std::move(name), std::move(options)) {}

  Output<T> port;

  /// The last one counts.
  void Set(const T& value) {
    if (!loan_) loan_ = port.Loan();
    if (loan_) *loan_ = value;
  }
  /// A buffer to fill, for values that are not to be copied; empty if a pool of fixed size is exhausted.
  [[nodiscard]] Loan<T>& Fill() {
    if (!loan_) loan_ = port.Loan();
    return loan_;
  }

 private:
  void Publish() override {
    if (loan_) port.Publish(std::exchange(loan_, {}));
  }
  void Discard() override { loan_ = {}; }

  Loan<T> loan_;
};

/// A part of a behaviour's activity, by which it stimulates or inhibits others. It stays as it was until
/// Behave() sets it again, and may not be greater than the activity.
class DerivedActivity final : public HeldBack {
 public:
  template <typename SomeBehaviour>
  DerivedActivity(SomeBehaviour* behaviour, std::string name, OutputOptions options = {})
      : HeldBack(*behaviour),
        port(behaviour, std::move(name), std::move(options)),
        behaviour_(behaviour),
        place_(AddTo(*behaviour)) {}

  Output<Activity> port;

  /// Between 0 and the activity.
  void Set(double value);

 private:
  using Place = std::size_t;
  static Place AddTo(Behaviour& behaviour);
  void Publish() override;
  void Discard() override {}

  Behaviour* const behaviour_;
  const Place place_;
};

inline void Describe(TypeBuilder<StimulationMode>& type) {
  type.Name("StimulationMode").Values<StimulationMode::kAuto, StimulationMode::kEnabled, StimulationMode::kDisabled>();
}

/// What viewers show of a behaviour. Copied freely.
struct BehaviourState {
  double activation = 0.0;
  double activity = 0.0;
  double target_rating = 0.0;
  StimulationMode mode = StimulationMode::kAuto;

  friend bool operator==(const BehaviourState&, const BehaviourState&) = default;
};

inline void Describe(TypeBuilder<BehaviourState>& type) {
  type.Name("BehaviourState")
      .SemanticTag("behaviour_state")
      .Fields<&BehaviourState::activation, &BehaviourState::activity, &BehaviourState::target_rating,
              &BehaviourState::mode>();
}

/// For checks of networks: on whose activity it depends whether a behaviour is active, by the inputs to which that comes.
struct ActivityNeeds {
  std::vector<const Port*> all_of = {};  ///< not active unless all of these are
  std::vector<const Port*> any_of = {};  ///< active, if it may, exactly while one of these is
};

/// A behaviour of a network (iB2C): a module that is stimulated and inhibited, does something with what activation that
/// leaves, and tells others how much it does (activity) and how far it is from what it wants (target rating).
///
///     class Follow final : public Behaviour {
///      public:
///       using Behaviour::Behaviour;
///       Input<double> distance{this, "distance"};
///       ControlOutput<Twist2> twist{this, "twist"};
///
///      private:
///       std::optional<Outcome> Behave(double activation) override {
///         const auto seen = distance.Read();
///         if (!seen) return {};
///         twist.Set({.forward = *seen});
///         const double rating = std::min(1.0, *seen);
///         return Outcome{.activity = activation * rating, .target_rating = rating};
///       }
///     };
///
/// One cycle:   stimulation and inhibitions make the activation; Behave(); the rules are checked (behaviour_rules.h); then
///              activity, target rating, derived activities, state and control outputs are published.
/// Stimulation: of a port that nothing comes to it is 0, and a warning says so. Inhibitions that nothing comes to do not count.
/// Threads:     as Module. Allocation: none in a cycle.
/// Errors:      a rule that is broken, or a signal that is not within 0 and 1, is a fault with the figures, before anything
///              of that cycle is published.
class Behaviour : public Module {
 public:
  explicit Behaviour(const Placement& placement);

  Input<Stimulation> stimulation{
      this, "stimulation", {.description = "how much it is wanted", .ageing = Ageing::kWhileSourceRuns}};
  Output<Activity> activity{this, "activity", {.description = "how much it does"}};
  Output<TargetRating> target_rating{
      this, "target_rating", {.description = "0: content; 1: as far from what it wants as can be"}};
  Output<BehaviourState> state{this, "behaviour", {.description = "all of it at once, for viewers"}};

  static constexpr std::uint32_t kMostInhibitions = 64;
  StaticParameter<std::uint32_t> inhibitions{this,
                                             "inhibitions",
                                             {.default_value = 1,
                                              .bounds = {0, kMostInhibitions},
                                              .description = "how many ports: inhibition1, inhibition2 …"}};
  /// It counts from when it was said: signals may go round, and what they were measured by never renews then.
  InputTimeout inhibition_timeout{this, "inhibition", {.counts_from_publication = true}};
  Parameter<StimulationMode> stimulation_mode{
      this,
      "stimulation_mode",
      {.default_value = StimulationMode::kAuto,
       .description = "auto: as the port says; enabled: fully; disabled: not at all"}};
  Parameter<std::uint32_t> warning_interval{
      this,
      "warning_interval",
      {.default_value = 250, .bounds = {1, 1000000}, .description = "cycles from one warning to the next, at least"}};

  [[nodiscard]] Input<Inhibition>& inhibition(std::size_t index) { return inhibition_ports_[index]; }
  /// Of a constructed behaviour with its present parameters. Most depend on what only they know.
  [[nodiscard]] virtual ActivityNeeds Needs() const { return {}; }
  [[nodiscard]] std::size_t inhibition_count() const noexcept { return inhibition_ports_.size(); }

 protected:
  struct Outcome {
    double activity = 0.0;
    double target_rating = 0.0;
  };
  /// What it does with so much activation. Outputs are set, not published (ControlOutput). Nothing: it cannot tell, since
  /// something is missing; nothing of it is published then, it is active in nothing, its target rating stays as it was (1
  /// if it never could tell), and a warning says why (Miss()).
  virtual std::optional<Outcome> Behave(double activation) = 0;
  /// As OnParametersChanged() of modules.
  virtual void OnBehaviourParametersChanged() {}
  /// Who overrides it calls this one, too.
  Result<void> Construct() override;
  Result<void> Prepare() override;

  /// For Behave(): `return Miss("nothing has come to its goal");` Any text that lives as long as this.
  [[nodiscard]] std::nullopt_t Miss(const char* reason) noexcept {
    missed_ = reason;
    return std::nullopt;
  }
  /// In the log, no more often than `warning_interval` says.
  void Warn(const char* text);

 private:
  friend class HeldBack;
  friend class DerivedActivity;

  void Update() final;
  void RunOnce();
  void OnParametersChanged() final;
  // Nothing: who inhibits it has not been heard for long, so it cannot tell.
  [[nodiscard]] std::optional<double> ReadActivation();
  [[nodiscard]] double ReadStimulation();
  [[nodiscard]] std::optional<Outcome> TryToBehave(double& activation);
  [[nodiscard]] bool HasSameActivities();
  void Hold(double activation);
  void PublishSignals(const MetaSignals& now);
  [[noreturn]] void Fail(const std::string& message) const;
  double CheckSignal(const char* name, double value) const;

  std::deque<Input<Inhibition>> inhibition_ports_;
  std::vector<double> inhibition_values_;
  std::vector<Input<Activity>*> activity_inputs_;
  std::vector<double> last_activities_;  // of those; -1: there is none
  std::vector<double> derived_;
  std::vector<HeldBack*> held_back_;
  std::optional<MetaSignals> before_;       // if it could tell
  MetaSignals last_{.target_rating = 1.0};  // who never could tell is not content
  bool has_new_parameters_ = false;
  const char* missed_ = nullptr;
  std::uint64_t cycle_ = 0;
  std::uint64_t warn_from_ = 0;
};

}  // namespace runnel
