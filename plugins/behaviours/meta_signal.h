#pragma once

#include <stdexcept>
#include <string>

#include "core/types/type_of.h"
#include "plugins/behaviours/algorithm/behaviour_rules.h"

namespace runnel {

enum class MetaSignalKind { kStimulation, kInhibition, kActivity, kTargetRating };

/// A signal of behaviours about themselves, within [0, 1]. Four types, so that what must not be connected cannot be:
/// stimulation and inhibition take their like and activities (RegisterMetaSignals()).
///
/// Errors: the constructor throws std::out_of_range for any other number.
template <MetaSignalKind kKind>
class MetaSignal {
 public:
  constexpr MetaSignal() = default;
  explicit constexpr MetaSignal(double value) : value_(value) {
    if (!IsMetaValue(value)) {
      throw std::out_of_range(std::string(kTypeNames[kPlace]) + " is within 0 and 1, not " + TextOf(value));
    }
  }

  /// What others have put together field by field (values set by hand) may be out of the range.
  [[nodiscard]] constexpr double value() const noexcept { return value_; }

  friend constexpr bool operator==(const MetaSignal&, const MetaSignal&) = default;
  friend void Describe(TypeBuilder<MetaSignal>& type) {
    type.Name(kTypeNames[kPlace])
        .SemanticTag(kMeanings[kPlace])
        .Field("value", &MetaSignal::value_, {.description = "0 .. 1"});
  }

 private:
  static constexpr const char* kTypeNames[] = {"Stimulation", "Inhibition", "Activity", "TargetRating"};
  static constexpr const char* kMeanings[] = {"stimulation", "inhibition", "activity", "target_rating"};
  static constexpr auto kPlace = static_cast<std::size_t>(kKind);

  double value_ = 0.0;
};

using Stimulation = MetaSignal<MetaSignalKind::kStimulation>;    ///< how much a behaviour is wanted
using Inhibition = MetaSignal<MetaSignalKind::kInhibition>;      ///< how much it is held back
using Activity = MetaSignal<MetaSignalKind::kActivity>;          ///< how much it does
using TargetRating = MetaSignal<MetaSignalKind::kTargetRating>;  ///< how far it is from content

/// Makes it known what meta signals may be connected to: an activity also to stimulations, inhibitions and numbers, a
/// target rating to numbers. Each behaviour sees to it; any thread, any number of times.
void RegisterMetaSignals();

}  // namespace runnel
