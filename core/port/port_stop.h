#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/channel/value_times.h"
#include "core/element/robot_stop.h"
#include "core/port/driving_kind.h"
#include "core/types/any_value.h"

namespace runnel {

class Port;

/// What readers of a port find while it is stopped, and whether it is: by the STOP of the robot, which all driving ports
/// follow, or by a block of this port alone. It belongs to the port, and goes over to one that takes its place.
///
/// Threads:  any; LetsPass() is wait-free. What it refers to outlives the runtime.
class PortStop {
 public:
  /// `robot`: nullptr for a port that does not drive. `before`: whose block it keeps; nullptr: it has a new one.
  PortStop(AnyValue safe_value, Duration brake, DrivingKind command, std::shared_ptr<StopSignal> robot,
           const PortStop* before = nullptr)
      : safe_value_(std::move(safe_value)),
        brake_(brake),
        command_(command),
        robot_(std::move(robot)),
        block_(before != nullptr ? before->block_ : std::make_shared<StopSignal>()) {}

  [[nodiscard]] const AnyValue& safe_value() const noexcept { return safe_value_; }
  /// How long readers find values between the one that they have read last and the safe one; 0: the safe one at once.
  [[nodiscard]] Duration brake() const noexcept { return brake_; }
  /// Unspecified only of a port that does not drive.
  [[nodiscard]] DrivingKind command() const noexcept { return command_; }
  [[nodiscard]] const std::shared_ptr<StopSignal>& robot() const noexcept { return robot_; }
  [[nodiscard]] const std::shared_ptr<StopSignal>& block() const noexcept { return block_; }

  /// The later one of both (StopSignal::bar()).
  [[nodiscard]] std::int64_t bar() const noexcept {
    return robot_ ? std::max(robot_->bar(), block_->bar()) : block_->bar();
  }
  [[nodiscard]] bool in_force() const noexcept { return bar() == StopSignal::kInForce; }
  /// Whether readers may find a value of these times, or find the safe value instead: no command from before a
  /// release moves anything after it, nor one whose measurements are from before.
  [[nodiscard]] bool LetsPass(ValueTimes times) const noexcept {
    const std::int64_t bar = this->bar();
    return bar == StopSignal::kNever || (times.timestamp.time_since_epoch().count() > bar &&
                                         times.publication_time.time_since_epoch().count() > bar);
  }

 private:
  const AnyValue safe_value_;
  const Duration brake_;
  const DrivingKind command_;
  const std::shared_ptr<StopSignal> robot_;
  const std::shared_ptr<StopSignal> block_;
};

namespace internal {

/// A stop on the way to an input, with its safe value as it comes there.
struct PassedStop {
  std::shared_ptr<const PortStop> stop;
  AnyValue safe_value;
};

/// Those of the port and of all that feeds it, as its readers find them. Under the structure lock.
[[nodiscard]] std::vector<PassedStop> PassedStops(const Port& port);

}  // namespace internal

}  // namespace runnel
