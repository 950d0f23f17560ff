#pragma once

#include "tests/core/port/port_fixture.h"

namespace runnel::test {

inline const OutputOptions kPullable{.pullable = true};
inline const InputOptions kPulls{.strategy = Strategy::kPull};

/// Ports and a counter that provides.
class PullTest : public PortTest {
 protected:
  // Counts up by one with each pull.
  static bool Count(int& value, int& counter) {
    value = ++counter;
    return true;
  }
  static bool Count(Scan& value, int& counter) {
    value.ranges.assign(20, static_cast<float>(++counter));
    value.number = counter;
    return true;
  }
  int counter = 0;
};

}  // namespace runnel::test
