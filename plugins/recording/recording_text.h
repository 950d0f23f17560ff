#pragma once

#include <cstdint>
#include <string>

#include "plugins/recording/recorder.h"

namespace runnel {

/// "recorded 1234 values of 5 ports, 1.2 MB, to run.mcap", with what was lost, and an end of line.
[[nodiscard]] std::string RecordingText(const std::string& file, const RecordingStatus& status);

/// "1.2 MB".
[[nodiscard]] std::string SizeText(std::uint64_t bytes);

}  // namespace runnel
