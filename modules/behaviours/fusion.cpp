#include "modules/behaviours/fusion.h"

#include <cmath>

#include "core/conversion/number_conversion.h"
#include "core/element/framework_element.h"
#include "core/port/port_stop.h"
#include "core/types/type_of.h"
#include "modules/flow/passing_module.h"

namespace runnel {

namespace {

bool IsBroken(const TypeInfo& type) { return &type == &TypeOf<double>() || &type == &TypeOf<float>(); }

}  // namespace

Result<ValueFusion> ValueFusion::Make(const TypeInfo& type, const std::string& unit, std::size_t values) {
  const std::shared_ptr<void> value = type.Make();
  if (value == nullptr)
    return Error{.message = "values of type " + type.name() + " can be made by their own module only"};
  ValueFusion fusion(type);
  if (auto added = fusion.AddNumbers(type, unit, value.get(), value.get()); !added) return added.error();
  fusion.found_.resize(values);
  return fusion;
}

Result<void> ValueFusion::AddNumbers(const TypeInfo& type, const std::string& unit, void* at, const void* value) {
  if (internal::IsNumber(type) && &type != &TypeOf<bool>()) {
    const auto offset = static_cast<const std::byte*>(at) - static_cast<const std::byte*>(value);
    numbers_.push_back({static_cast<std::size_t>(offset), &type, unit == "rad"});
    return {};
  }
  switch (type.kind()) {
    case TypeKind::kEnumeration:
      return {};
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        if (auto added = AddNumbers(*field.type, field.unit, field.address(at), value); !added) return added;
      }
      return {};
    case TypeKind::kSequence:
    case TypeKind::kMatrix: {
      const ElementOperations& elements = type.elements();
      if (!elements.is_fixed) break;
      const std::size_t count = elements.rows(at) * elements.columns(at);
      for (std::size_t i = 0; i < count; ++i) {
        if (auto added = AddNumbers(*elements.type, unit, elements.element(at, i), value); !added) return added;
      }
      return {};
    }
    case TypeKind::kLeaf:
      if (&type == &TypeOf<bool>()) return {};
      break;
    case TypeKind::kOpaque:
      break;
  }
  return Error{.message = "values of type " + type_->name() + " cannot be weighted: there is '" + type.name() +
                          "' in them, which is neither a number nor of a fixed size",
               .hint = "the method winner_takes_all takes values of any type"};
}

void ValueFusion::Fuse(std::span<const double> weights, std::span<const void* const> values, std::size_t winner,
                       void* fused) {
  (void)CopyValue(*type_, values[winner], fused);
  for (const Number& number : numbers_) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] == nullptr) continue;
      found_[i] = internal::NumberIn(*number.type, static_cast<const std::byte*>(values[i]) + number.offset);
    }
    const std::span<const double> numbers(found_.data(), values.size());
    double sum = number.is_angle ? FuseAngles(weights, numbers, winner) : FuseNumbers(weights, numbers);
    if (!IsBroken(*number.type)) sum = std::round(sum);
    internal::SetNumber(*number.type, static_cast<std::byte*>(fused) + number.offset, sum);
  }
}

Result<void> FusionBehaviour::Construct() {
  if (auto made = Behaviour::Construct(); !made) return made;
  const auto ports = flow::FindPortsByName(type.Get());
  if (!ports) return ports.error().WithPath(type.path());
  const std::uint32_t count = channels.Get();
  for (std::uint32_t i = 1; i <= count; ++i) {
    const std::string number = std::to_string(i);
    activities_.emplace_back(this, "activity" + number, Measured("how active the behaviour is"));
    target_ratings_.emplace_back(this, "target_rating" + number, Measured("how content it is"));
    InputOptions wanted = Measured("what it wants");
    wanted.unit = unit.Get();
    inputs_.push_back((*ports)->MakeInput(InputGroup(), "in" + number, wanted));
  }
  output_ = (*ports)->MakeOutput(OutputGroup(), "out", {.description = "what all of them come to", .unit = unit.Get()});
  if (output_ == nullptr) {
    return Error{.message = "values of type '" + type.Get() + "' can be made by their own module only",
                 .path = type.path()};
  }
  values_ = (*ports)->MakeHeldValues(count);
  auto fusion = ValueFusion::Make(output_->type(), unit.Get(), count);
  if (fusion) {
    value_fusion_ = std::move(*fusion);
  } else {
    no_fusion_ = fusion.error().message;
  }
  if (IsVelocity(output_->type(), unit.Get())) standstill_ = output_->type().Make();
  signals_.resize(count);
  weights_.resize(count);
  found_.resize(count);
  return {};
}

Result<void> FusionBehaviour::Attach(std::size_t channel, Behaviour& behaviour, Port& wish) {
  if (channel == 0 || channel > inputs_.size()) {
    return Error{.message = "there is no channel " + std::to_string(channel), .path = path()};
  }
  const std::size_t i = channel - 1;
  if (auto connected = Port::Connect(behaviour.activity, activities_[i]); !connected) return connected;
  if (auto connected = Port::Connect(behaviour.target_rating, target_ratings_[i]); !connected) return connected;
  return Port::Connect(wish, *inputs_[i]);
}

ActivityNeeds FusionBehaviour::Needs() const {
  ActivityNeeds needs;
  for (const Input<Activity>& each : activities_) needs.any_of.push_back(&each);
  return needs;
}

Result<void> FusionBehaviour::Prepare() {
  if (!value_fusion_ && method.Get() != FusionMethod::kWinnerTakesAll) {
    return Error{
        .message = no_fusion_, .path = method.path(), .hint = "the method winner_takes_all takes values of any type"};
  }
  return Behaviour::Prepare();
}

void FusionBehaviour::OnBehaviourParametersChanged() {
  chosen_ = method.Get();
  if (value_fusion_ || chosen_ == FusionMethod::kWinnerTakesAll) return;
  throw ElementError({.message = no_fusion_, .path = method.path()});
}

const char* FusionBehaviour::ReadSignals() {
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const auto active = activity_timeout.Read(activities_[i], now());
    if (!active) return activity_timeout.words();
    const auto rated = target_rating_timeout.Read(target_ratings_[i], now());
    if (!rated) return target_rating_timeout.words();
    signals_[i] = {active->value(), rated->value()};
    if (!IsMetaValue(signals_[i].activity) || !IsMetaValue(signals_[i].target_rating)) {
      throw ElementError({.message = "what comes to channel " + std::to_string(i + 1) + ", activity " +
                                     TextOf(signals_[i].activity) + " and target rating " +
                                     TextOf(signals_[i].target_rating) + ", is not within 0 and 1",
                          .path = path()});
    }
  }
  return nullptr;
}

const char* FusionBehaviour::ReadValues() {
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    found_[i] = nullptr;
    if (weights_[i] == 0.0) continue;
    (void)in_timeout.Read(*inputs_[i], *values_, i);
    found_[i] = values_->Find(i);
    if (found_[i] == nullptr) return in_timeout.words();
  }
  return nullptr;
}

std::optional<Behaviour::Outcome> FusionBehaviour::Behave(double activation) {
  if (const char* const lack = ReadSignals()) return Miss(lack);
  const FusedSignals fused = Fuse(chosen_, signals_, activation);
  winner_ = fused.winner;
  WeighChannels(chosen_, signals_, weights_);
  if (const char* const lack = ReadValues()) return Miss(lack);
  has_fused_ = true;
  return Outcome{fused.activity, fused.target_rating};
}

void FusionBehaviour::PublishFused() {
  const bool is_anybody_active = signals_[winner_].activity > 0.0;
  if (has_fused_ && (is_anybody_active || standstill_)) {
    // As it is, unless what has come from another channel is older.
    const bool is_forwarded = is_anybody_active && chosen_ == FusionMethod::kWinnerTakesAll &&
                              (!value_fusion_ || values_->times(winner_).timestamp <= CurrentCycle()->stamp);
    if (is_forwarded) {
      values_->Forward(*output_, winner_);
    } else {
      (void)output_->PublishFilled([&](void* value) -> Result<void> {
        if (!is_anybody_active) {
          (void)CopyValue(output_->type(), standstill_.get(), value);
          return {};
        }
        value_fusion_->Fuse(weights_, found_, winner_, value);
        return {};
      });
    }
  }
  DiscardFused();
}

void FusionBehaviour::DiscardFused() {
  has_fused_ = false;
  for (std::size_t i = 0; i < weights_.size(); ++i) values_->Drop(i);
}

}  // namespace runnel
