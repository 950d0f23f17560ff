#include "modules/behaviours/conditional_stimulator.h"

namespace runnel {

namespace {

std::uint32_t Latched(const std::vector<ConditionState>& states) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].is_latched) bits |= 1U << i;
  }
  return bits;
}

bool IsFedByActivity(const Port& port) {
  const auto sources = port.Sources();
  return sources.size() == 1 && &sources.front()->type() == &TypeOf<Activity>();
}

}  // namespace

Result<void> ConditionalStimulator::Construct() {
  if (auto made = Behaviour::Construct(); !made) return made;
  for (std::uint32_t i = 1; i <= inputs.Get(); ++i) Add("input" + std::to_string(i), inputs_, false);
  for (std::uint32_t i = 1; i <= feedbacks.Get(); ++i) Add("feedback" + std::to_string(i), feedbacks_, true);
  return {};
}

// `goes_round`: it comes of what this one stimulates.
void ConditionalStimulator::Add(const std::string& name, Conditions& conditions, bool goes_round) {
  const Ageing ageing = goes_round ? Ageing::kSetOnce : Ageing::kTimesOut;
  conditions.ports.emplace_back(this, name,
                                InputOptions{.description = "what is compared", .required = true, .ageing = ageing});
  conditions.timeouts.emplace_back(this, conditions.ports.back(),
                                   InputTimeout::Options{.counts_from_publication = goes_round});
  conditions.kinds.emplace_back(
      this, name + "_kind",
      ParameterOptions<ConditionKind>{.default_value = Condition{}.kind,
                                      .description = "permanent: holds now; ordering: has held; enabling: has "
                                                     "held while all others did"});
  conditions.relations.emplace_back(this, name + "_relation",
                                    ParameterOptions<Relation>{.default_value = Condition{}.relation,
                                                               .description = "of the value to the threshold"});
  conditions.thresholds.emplace_back(
      this, name + "_threshold",
      ParameterOptions<double>{.default_value = Condition{}.threshold, .description = "what it is compared with"});
  conditions.states.emplace_back();
}

void ConditionalStimulator::TakeParameters(Conditions& conditions) {
  for (std::size_t i = 0; i < conditions.states.size(); ++i) {
    conditions.states[i].condition = {conditions.kinds[i].Get(), conditions.relations[i].Get(),
                                      conditions.thresholds[i].Get()};
  }
}

void ConditionalStimulator::OnBehaviourParametersChanged() {
  TakeParameters(inputs_);
  TakeParameters(feedbacks_);
}

ActivityNeeds ConditionalStimulator::Needs() const {
  ActivityNeeds needs;
  for (std::size_t i = 0; i < inputs_.ports.size(); ++i) {
    const bool is_permanent = inputs_.kinds[i].Get() == ConditionKind::kPermanent;
    const Relation relation = inputs_.relations[i].Get();
    const double threshold = inputs_.thresholds[i].Get();
    const bool is_something =
        (relation == Relation::kGreater && threshold >= 0.0) || (relation == Relation::kAtLeast && threshold > 0.0);
    if (is_permanent && is_something && IsFedByActivity(inputs_.ports[i])) needs.all_of.push_back(&inputs_.ports[i]);
  }
  return needs;
}

bool ConditionalStimulator::ReadValues(Conditions& conditions, std::uint32_t met) {
  for (std::size_t i = 0; i < conditions.states.size(); ++i) {
    const auto value = conditions.timeouts[i].Read(conditions.ports[i], now());
    if (!value) {
      (void)Miss(conditions.timeouts[i].words());
      return false;
    }
    conditions.states[i].value = *value;
    conditions.states[i].is_latched = (met & 1U << i) != 0;
  }
  return true;
}

std::optional<Behaviour::Outcome> ConditionalStimulator::Behave(double activation) {
  if (reset.Read().is_new()) met_ = {};
  if (!ReadValues(inputs_, met_.inputs) || !ReadValues(feedbacks_, met_.feedbacks)) return {};
  const bool is_met = AreAllTrue(inputs_.states);
  if (AreAllTrue(feedbacks_.states) && !feedbacks_.states.empty()) {
    Reset(inputs_.states);
    Reset(feedbacks_.states);
  }
  met_ = {Latched(inputs_.states), Latched(feedbacks_.states)};
  return Outcome{is_met ? activation : 0.0, is_met ? 1.0 : 0.0};
}

}  // namespace runnel
