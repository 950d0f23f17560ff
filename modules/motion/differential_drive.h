#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/motion/algorithm/differential_drive.h"
#include "modules/types/pose.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

/// Turns the wish how the body shall move into wheel speeds, within the limits of the drive and
/// without sudden changes. Without any command, or with an old one only, the wheels come to a stop; while the robot is stopped
/// they stand at once.
class DifferentialDriveModule final : public Module {
 public:
  using Module::Module;

  Input<Twist2> twist{this, "twist", Driving("how the body shall move")};
  Output<WheelSpeeds> wheels{this, "wheels", {.description = "what the wheels shall do"}};

  Parameter<double> wheel_radius{this, "wheel_radius", {.default_value = 0.05, .bounds = {0.001, 2.0}, .unit = "m"}};
  Parameter<double> track{
      this,
      "track",
      {.default_value = 0.25, .bounds = {0.01, 10.0}, .unit = "m", .description = "from wheel to wheel"}};
  Parameter<double> maximum_speed{
      this,
      "maximum_speed",
      {.default_value = 0.5, .bounds = {0.0, 20.0}, .unit = "m/s", .description = "of the body"}};
  Parameter<double> maximum_turn_rate{
      this,
      "maximum_turn_rate",
      {.default_value = 1.5, .bounds = {0.0, 50.0}, .unit = "rad/s", .description = "of the body"}};
  Parameter<double> acceleration{
      this,
      "acceleration",
      {.default_value = 1.0, .bounds = {0.01, 100.0}, .unit = "m/s^2", .description = "of the body, ahead or back"}};
  Parameter<double> turn_acceleration{
      this,
      "turn_acceleration",
      {.default_value = 6.0, .bounds = {0.01, 500.0}, .unit = "rad/s^2", .description = "of the body"}};
  InputTimeout twist_timeout{this, twist, {.former_name = "timeout", .log = &log()}};

 private:
  void Update() override {
    const DifferentialDrive drive{.wheel_radius = wheel_radius.Get(),
                                  .track = track.Get(),
                                  .maximum_speed = maximum_speed.Get(),
                                  .maximum_turn_rate = maximum_turn_rate.Get()};
    const AccelerationLimit limit{.forward = acceleration.Get(), .turn = turn_acceleration.Get()};
    const auto command = twist_timeout.Read(twist, now());
    const Twist2 wanted = WithinLimits(drive, command ? *command : Twist2{});
    const double time_step = ToSeconds(now() - last_.value_or(now()));
    last_ = now();
    // Stopped, here or behind it, or paused for so long that the wheels have come to rest: from a standstill.
    const std::uint32_t beginning = wheels.FollowMotionBeginnings();
    const std::int64_t bar =
        runtime().robot_stop().signal()->bar();  // also of a STOP that was released before this cycle
    const bool is_released = std::exchange(beginning_, beginning) != beginning || std::exchange(bar_, bar) != bar;
    const bool begins = is_released || twist.is_stopped() || time_step > twist_timeout.limit.Get();
    current_ = begins ? Twist2{} : Approach(limit, current_, wanted, time_step);
    wheels.Publish(WheelSpeedsFor(drive, current_));
  }

  Twist2 current_;
  std::optional<Time> last_;
  std::uint32_t beginning_ = 0;
  std::int64_t bar_ = StopSignal::kNever;
};

}  // namespace runnel
