#include "plugins/network/network_options.h"

namespace runnel {

const std::vector<std::string>& ValueQualityNames() {
  static const std::vector<std::string> names = {"newest", "each", "sensor", "latched"};
  return names;
}

const std::vector<std::string>& ValueSendingNames() {
  static const std::vector<std::string> names = {"network", "after_cycle"};
  return names;
}

const std::vector<std::string>& FarCommandNames() {
  static const std::vector<std::string> names = {"set", "swap"};
  return names;
}

WireQos QosOf(ValueQuality quality) {
  switch (quality) {
    case ValueQuality::kNewest:
      return {};
    case ValueQuality::kEach:
      return {.depth = 128};
    case ValueQuality::kSensor:
      return {.is_reliable = false, .depth = 5};
    case ValueQuality::kLatched:
      return {.is_latched = true};
  }
  return {};
}

}  // namespace runnel
