#include "plugins/recording/recording_text.h"

#include <fmt/format.h>

#include "core/port/port.h"
#include "plugins/recording/recording_names.h"

namespace runnel {

std::string SizeText(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", size / 1e3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", size / 1e6);
  return fmt::format("{:.2f} GB", size / 1e9);
}

std::string RecordingText(const std::string& file, const RecordingStatus& status) {
  std::string text = "recorded " + std::to_string(status.values) + " values of " +
                     std::to_string(status.ports) + (status.ports == 1 ? " port, " : " ports, ") +
                     SizeText(status.bytes) + ", to " + file;
  if (status.dropped > 0) {
    text += "; " + std::to_string(status.dropped) + " came too fast and are not in it";
  }
  if (!status.left_out.empty()) {
    text += "; not recorded, because their values have no form to be written in:";
    for (const std::string& path : status.left_out) text += " " + ShortPortPath(path);
  }
  if (!status.idle_patterns.empty()) {
    text += "; no port has fitted";
    for (const std::string& pattern : status.idle_patterns) text += " '" + pattern + "'";
  }
  return text + "\n";
}

}  // namespace runnel
