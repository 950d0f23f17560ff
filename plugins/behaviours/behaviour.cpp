#include "plugins/behaviours/behaviour.h"

#include <algorithm>

#include <fmt/format.h>

namespace runnel {

HeldBack::HeldBack(Behaviour& behaviour) { behaviour.held_back_.push_back(this); }

void DerivedActivity::Set(double value) { behaviour_->derived_[place_] = value; }

DerivedActivity::Place DerivedActivity::AddTo(Behaviour& behaviour) {
  behaviour.derived_.push_back(0.0);
  return behaviour.derived_.size() - 1;
}

void DerivedActivity::Publish() { port.Publish(Activity(behaviour_->derived_[place_])); }

Behaviour::Behaviour(const Placement& placement) : Module(placement) { RegisterMetaSignals(); }

Result<void> Behaviour::Construct() {
  for (std::uint32_t i = 1; i <= inhibitions.Get(); ++i) {
    inhibition_ports_.emplace_back(
        this, "inhibition" + std::to_string(i),
        InputOptions{.description = "how much it is held back; the greatest counts", .ageing = Ageing::kSetOnce});
  }
  inhibition_values_.assign(inhibition_ports_.size(), 0.0);
  return {};
}

Result<void> Behaviour::Prepare() {
  activity_inputs_.clear();
  for (FrameworkElement* const port : InputGroup().children()) {
    if (auto* const input = dynamic_cast<Input<Activity>*>(port)) activity_inputs_.push_back(input);
  }
  last_activities_.assign(activity_inputs_.size(), -1.0);
  return {};
}

void Behaviour::OnParametersChanged() {
  has_new_parameters_ = true;
  OnBehaviourParametersChanged();
}

void Behaviour::Update() {
  ++cycle_;
  for (HeldBack* const each : held_back_) each->Discard();
  try {
    RunOnce();
  } catch (...) {
    // It may stay for long, failed as it is: it keeps no value that others need back.
    for (HeldBack* const each : held_back_) each->Discard();
    throw;
  }
}

void Behaviour::RunOnce() {
  const bool is_unchanged = HasSameActivities() && !std::exchange(has_new_parameters_, false);
  MetaSignals signals;
  const auto outcome = TryToBehave(signals.activation);
  if (!outcome) return Hold(signals.activation);
  signals.activity = CutRounding(outcome->activity, signals.activation);
  signals.target_rating = CutRounding(outcome->target_rating, 1.0);
  for (double& each : derived_) each = CutRounding(each, signals.activity);
  const std::string violation =
      FindViolation({.now = signals, .derived = derived_, .before = before_, .has_same_activities = is_unchanged});
  if (!violation.empty()) Fail(violation);
  before_ = last_ = signals;
  PublishSignals(signals);
  for (HeldBack* const each : held_back_) each->Publish();
}

void Behaviour::Hold(double activation) {
  Warn(missed_);
  before_.reset();  // what it does when it can tell again is no change of its own
  last_.activation = activation;
  last_.activity = 0.0;
  std::ranges::fill(derived_, 0.0);
  PublishSignals(last_);
  for (HeldBack* const each : held_back_) each->Discard();
  for (HeldBack* const each : held_back_) each->Publish();
}

std::optional<Behaviour::Outcome> Behaviour::TryToBehave(double& activation) {
  const auto read = ReadActivation();
  if (!read) return {};
  activation = *read;
  missed_ = "it cannot tell what to do";
  return Behave(activation);
}

double Behaviour::ReadStimulation() {
  const auto wanted = stimulation.Peek();
  const auto mode = stimulation_mode.Get();
  if (mode != StimulationMode::kAuto) {
    if (wanted) Warn("what comes to its stimulation does not count: stimulation_mode is not auto");
    return mode == StimulationMode::kEnabled ? 1.0 : 0.0;
  }
  if (wanted) return CheckSignal("its stimulation", wanted->value());
  Warn("nothing comes to its stimulation, so it does nothing: connect it, or set stimulation_mode to enabled");
  return 0.0;
}

std::optional<double> Behaviour::ReadActivation() {
  for (std::size_t i = 0; i < inhibition_ports_.size(); ++i) {
    const auto held_back = inhibition_timeout.Read(inhibition_ports_[i], now());
    const bool is_silent = !held_back && inhibition_ports_[i].is_bound() && !inhibition_timeout.is_awaited(now());
    if (is_silent) return Miss(inhibition_timeout.words());
    inhibition_values_[i] = held_back ? CheckSignal("an inhibition", held_back->value()) : 0.0;
  }
  return Activation(ReadStimulation(), inhibition_values_);
}

bool Behaviour::HasSameActivities() {
  bool are_same = true;
  for (std::size_t i = 0; i < activity_inputs_.size(); ++i) {
    const auto value = activity_inputs_[i]->Peek();
    const double now = value ? value->value() : -1.0;
    are_same = std::exchange(last_activities_[i], now) == now && are_same;
  }
  return are_same;
}

void Behaviour::PublishSignals(const MetaSignals& now) {
  activity.Publish(Activity(now.activity));
  target_rating.Publish(TargetRating(now.target_rating));
  state.Publish({now.activation, now.activity, now.target_rating, stimulation_mode.Get()});
}

void Behaviour::Warn(const char* text) {
  if (cycle_ < warn_from_) return;
  warn_from_ = cycle_ + warning_interval.Get();
  log().Warn("{}", std::string_view(text));
}

void Behaviour::Fail(const std::string& message) const { throw ElementError({.message = message, .path = path()}); }

double Behaviour::CheckSignal(const char* name, double value) const {
  if (!IsMetaValue(value)) Fail(fmt::format("{} is {}, which is not within 0 and 1", name, value));
  return value;
}

}  // namespace runnel
