#pragma once

#include <algorithm>
#include <cmath>
#include <span>

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

}  // namespace runnel
