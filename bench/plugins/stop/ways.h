#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/plugins/stop/robot.h"

namespace runnel::bench {

/// A way by which STOP is asked for.
class Way {
 public:
  virtual ~Way() = default;
  /// Presses, waits until the reader of the first base finds the safe value, and says how long that took, in ms.
  [[nodiscard]] virtual double Press() = 0;
};

struct KindOfWay {
  std::string name;
  /// Nothing: it cannot be had here; the reason has been said.
  std::unique_ptr<Way> (*make)(Robot& robot, bool fills_page);
};

[[nodiscard]] const std::vector<KindOfWay>& KindsOfWays();

}  // namespace runnel::bench
