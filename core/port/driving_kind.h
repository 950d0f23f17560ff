#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/types/any_value.h"

namespace runnel {

/// What a value by which something moves says, as the command interfaces of ros2_control. A velocity comes to rest: when a STOP
/// or a value by hand ends, it begins from its safe value. A position is gone to at once, as that would be a motion, too. An
/// effort (force, torque, current, power) begins from its safe value where that is zero.
enum class DrivingKind { kUnspecified, kPosition, kVelocity, kEffort };

/// What an application says of a port by which something moves. What it leaves out is as the port's module declares, or as its
/// unit says.
struct DrivingMark {
  AnyValue safe_value;
  std::optional<Duration> brake;
  DrivingKind command = DrivingKind::kUnspecified;
};

/// How files write it: position, velocity, effort. In its order, from the first that is specified.
[[nodiscard]] const std::vector<std::string>& DrivingKindNames();
/// Precondition: specified.
[[nodiscard]] const std::string& NameOf(DrivingKind kind);
[[nodiscard]] std::optional<DrivingKind> DrivingKindCalled(std::string_view name);

/// Whether zero of the type is a standstill: a twist, or all that is inside is in m/s or rad/s. `unit`: of the port.
[[nodiscard]] bool IsVelocity(const TypeInfo& type, const std::string& unit = {});

/// Of the units of all that is inside; of none: unspecified. A type that has a length or an angle is a position, unless it also has
/// a speed of which it lacks the place, as the {steering angle, speed} of a car. Other units: an effort.
[[nodiscard]] DrivingKind DrivingKindByUnits(const TypeInfo& type, const std::string& unit);

/// Whether there are values between others of the type: numbers, inside of it too, and not just states.
[[nodiscard]] bool HasNumbers(const TypeInfo& type);

/// Whether a part of it is a list of any length, so that the value that its type begins with says nothing of what it holds.
[[nodiscard]] bool HasLists(const TypeInfo& type);

/// Whether it is what its type begins with.
[[nodiscard]] bool IsZero(const AnyValue& value);
/// Whether the safe value is one in each unit, too: zero, but of a position, for which it would be a motion.
[[nodiscard]] bool IsSafeInAnyUnit(const AnyValue& safe_value, DrivingKind command);

}  // namespace runnel
