#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>

namespace runnel {

/// Whether it is a number that a meta signal may have. False for what is no number (NaN).
[[nodiscard]] constexpr bool IsMetaValue(double value) { return value >= 0.0 && value <= 1.0; }

/// Who decides how much a behaviour is stimulated.
enum class StimulationMode {
  kAuto,      ///< what comes to its port
  kEnabled,   ///< fully, whatever comes
  kDisabled,  ///< not at all, whatever comes
};

/// s (1 - max i): what a behaviour may do at most. All within [0, 1]; no inhibition: 0.
[[nodiscard]] constexpr double Activation(double stimulation, std::span<const double> inhibitions) {
  double strongest = 0.0;
  for (const double each : inhibitions) strongest = std::max(strongest, each);
  return stimulation * (1.0 - strongest);
}

/// What a behaviour says of itself after one cycle. All within [0, 1].
struct MetaSignals {
  double activation = 0.0;
  double activity = 0.0;
  double target_rating = 0.0;  ///< 0: content, 1: not at all

  friend bool operator==(const MetaSignals&, const MetaSignals&) = default;
};

/// What the rules look at.
struct BehaviourCycle {
  MetaSignals now;
  std::span<const double> derived = {};    ///< derived activities
  std::optional<MetaSignals> before = {};  ///< of the last cycle, if there was one
  bool has_same_activities = false;        ///< all activities that it reads are what they were then
};

/// The rules of iB2C, by which a network can be reasoned about:
///
///   activity limitation    activity <= activation, and derived activities <= activity
///   goal state activity    a behaviour that is and was content changes its activity only with its activation
///                          or with activities that it reads
///
/// Which one is broken, with the figures; "" for none, and then without allocating. Sums that rounding has made too large by
/// kRoundingOfSignals are no violation: CutRounding() first.
[[nodiscard]] std::string FindViolation(const BehaviourCycle& cycle);

inline constexpr double kRoundingOfSignals = 1e-9;

/// `value`, or the limit that it is beyond by no more than rounding explains. The limits are 0 and `most`.
[[nodiscard]] double CutRounding(double value, double most);

}  // namespace runnel
