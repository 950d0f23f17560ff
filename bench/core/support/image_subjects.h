#pragma once

#include <optional>

#include "bench/core/workloads/image_transport.h"

namespace runnel::bench {

inline constexpr const char* kFillingSubject = "filling alone";
inline constexpr const char* kPortsSubject = "triggered modules";
inline constexpr const char* kWakeUpSubject = "filling + one wake-up";
inline constexpr const char* kPoolSubject = "mutex + cv + pool";

struct ImageCost {
  double cpu_percent = 0;  ///< of one core, all threads of the process
  double peak_megabytes = 0;
  double arrived = 1;  ///< share of the images that a reader saw, of all readers together
};

/// Runs the subject of that name for the time given. nullopt if there is none of that name.
std::optional<ImageCost> MeasureImageSubject(const ImageTransport& transport);

}  // namespace runnel::bench
