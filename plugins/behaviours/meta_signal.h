#pragma once

#include <stdexcept>
#include <string>

#include "core/types/type_of.h"
#include "plugins/behaviours/algorithm/behaviour_rules.h"

namespace runnel {

/// A signal of behaviours about themselves, within [0, 1]. Four types, so that what must not be connected cannot be:
/// stimulation and inhibition take their like and activities (RegisterMetaSignals()).
///
/// Errors: the constructor throws std::out_of_range for any other number.
template <typename Kind>
class MetaSignal {
 public:
  constexpr MetaSignal() = default;
  explicit constexpr MetaSignal(double value) : value_(value) {
    if (!IsMetaValue(value)) {
      throw std::out_of_range(std::string(Kind::kTypeName) + " is within 0 and 1, not " + TextOf(value));
    }
  }

  /// What others have put together field by field (values set by hand) may be out of the range.
  [[nodiscard]] constexpr double value() const noexcept { return value_; }

  friend constexpr bool operator==(const MetaSignal&, const MetaSignal&) = default;
  friend void Describe(TypeBuilder<MetaSignal>& type) {
    type.Name(Kind::kTypeName).SemanticTag(Kind::kMeaning).Field("value", &MetaSignal::value_, {.description = "0 .. 1"});
  }

 private:
  double value_ = 0.0;
};

namespace internal {
struct StimulationKind {
  static constexpr const char* kTypeName = "Stimulation";
  static constexpr const char* kMeaning = "stimulation";
};
struct InhibitionKind {
  static constexpr const char* kTypeName = "Inhibition";
  static constexpr const char* kMeaning = "inhibition";
};
struct ActivityKind {
  static constexpr const char* kTypeName = "Activity";
  static constexpr const char* kMeaning = "activity";
};
struct TargetRatingKind {
  static constexpr const char* kTypeName = "TargetRating";
  static constexpr const char* kMeaning = "target_rating";
};
}  // namespace internal

using Stimulation = MetaSignal<internal::StimulationKind>;    ///< how much a behaviour is wanted
using Inhibition = MetaSignal<internal::InhibitionKind>;      ///< how much it is held back
using Activity = MetaSignal<internal::ActivityKind>;          ///< how much it does
using TargetRating = MetaSignal<internal::TargetRatingKind>;  ///< how far it is from content

/// Makes it known what meta signals may be connected to: an activity also to stimulations, inhibitions and numbers, a
/// target rating to numbers. Each behaviour sees to it; any thread, any number of times.
void RegisterMetaSignals();

}  // namespace runnel
