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
  /// Presses, and waits until the readers of all bases that are driven find the safe value; how long each of them took, in ms.
  [[nodiscard]] virtual std::vector<double> Press() = 0;
};

struct KindOfWay {
  std::string name;
  /// Nothing: it cannot be had here; the reason has been said.
  std::unique_ptr<Way> (*make)(Robot& robot, bool fills_page);
};

[[nodiscard]] const std::vector<KindOfWay>& KindsOfWays();

}  // namespace runnel::bench
