#pragma once

#include <cstdint>
#include <optional>

#include "core/base/clock.h"
#include "core/port/port.h"

namespace runnel {

/// How many values have passed a port, and when the newest of them was published.
struct Publications {
  std::uint64_t count = 0;
  std::optional<Time> newest = {};
  /// Under the structure lock.
  [[nodiscard]] static Publications Of(const Port& port);
};

/// Publications a second, by the times between them and not between the looks: 5 Hz are 5 Hz, however often somebody
/// looks.
///
/// Threads:  one at a time.
class PublicationRate {
 public:
  /// Of what has come since the look before. 0 until two publications are known, and when none has come for longer than
  /// two periods. `time`: now, by the application's clock.
  double Look(const Publications& publications, Time time);

 private:
  Publications last_;
  double rate_ = 0;
};

}  // namespace runnel
