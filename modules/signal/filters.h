#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/element/robot_stop.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/signal/algorithm/filters.h"
#include "plugins/parameters/parameter.h"

namespace runnel::signal {

/// What small modules for one number have in common: each new value gives one, with the timestamp that it had.
class Filter : public Module {
 public:
  using Module::Module;

  Input<double> in{this, "in", {.required = true, .ageing = Ageing::kPassedOn}};
  Output<double> out{this, "out"};

 protected:
  /// `seconds`: from the value before to this one, by their timestamps; 0 for the first, and where time goes back.
  [[nodiscard]] virtual double Next(double value, double seconds) noexcept = 0;
  /// What has been put out does not count any more: it goes on from `value`.
  virtual void BeginAt(double /*value*/) noexcept {}
  /// Whether it goes on from what it has put out.
  [[nodiscard]] virtual bool is_ramp() const noexcept { return false; }
  /// Whether there is something to go on from: nothing has come from a module of another type in whose place it is.
  [[nodiscard]] virtual bool has_begun() const noexcept { return true; }
  /// For those that go on from what they have put out.
  template <typename State>
  void KeepCourse(State& state) {
    KeepState(course_);
    KeepState(state);
  }

 private:
  void Update() final {
    if (runtime().robot_stop().in_force()) course_.bar = StopSignal::kInForce;  // also while nothing comes
    if (in.is_stopped()) return PassSafeValue();
    if (in.has_queue()) {
      for (auto each = in.Take(); each; each = in.Take()) Pass(each);
    } else if (const auto read = in.Read(); read.is_new()) {
      Pass(read);
    }
  }
  // At once, and not on the way to it.
  void PassSafeValue() {
    while (in.Take()) {
    }
    const auto safe = in.Read();
    if (!in.is_stopped()) return Pass(safe);  // it has come after a release in between
    BeginAt(*safe);
    course_.last = now();
    out.Publish(*safe, safe.timestamp());
  }
  void Pass(const Lease<double>& value) {
    const Time time = value.timestamp();
    const bool begins = BeginsAnew(time);
    if (begins) {
      BeginAt(moves_by_velocity() ? 0 : out.motion_begins_at());
      course_.last = std::max(Time(Duration(course_.bar)), now() - period());
    }
    double seconds = course_.last && time > *course_.last ? ToSeconds(time - *course_.last) : 0;
    if (course_.beginning != 0) seconds = std::min(seconds, ToSeconds(longest()));  // a silence is no way that was gone
    course_.last = begins ? std::max(time, *course_.last) : time;  // from before a release there was no time to go
    out.Publish(Next(*value, seconds), time);
  }
  // With what moves by it. Asked once a value is there: one that came after a release finds that it was released.
  [[nodiscard]] bool BeginsAnew(Time time) noexcept {
    if (!is_ramp()) return false;
    const std::int64_t bar = runtime().robot_stop().signal()->bar();
    const Course before = course_;
    course_.bar = bar;
    course_.beginning = out.FollowMotionBeginnings();
    if (course_.beginning == 0) return false;
    // A position waits where it is while nothing comes, and begins at the first value; only a STOP has brought it elsewhere.
    if (!moves_by_velocity() && !before.last) return bar == StopSignal::kInForce || before.bar == StopSignal::kInForce;
    // In force it goes on: what it has made by the release counts nowhere.
    if (bar != StopSignal::kInForce && bar != before.bar) return true;
    if (!moves_by_velocity()) return before.beginning != 0 && course_.beginning != before.beginning;
    return course_.beginning != before.beginning || !has_begun() || (before.last && time - *before.last > longest());
  }

  [[nodiscard]] bool moves_by_velocity() const noexcept { return std::isnan(out.motion_begins_at()); }

  [[nodiscard]] Duration longest() const noexcept { return std::max(kTimedOut, 2 * period()); }

  static constexpr Duration kTimedOut = std::chrono::milliseconds(500);
  struct Course {
    std::optional<Time> last;  // of the value before
    std::int64_t bar = StopSignal::kNever;
    std::uint32_t beginning = 0;
  };
  Course course_;
};

class LowPassFilter final : public Filter {
 public:
  explicit LowPassFilter(const Placement& placement) : Filter(placement) { KeepCourse(state_); }
  Parameter<double> time_constant{this,
                                  "time_constant",
                                  {.default_value = 0.1,
                                   .bounds = {0, 1e6},
                                   .unit = "s",
                                   .description = "after it, 63 % of a step are done; 0: all"}};

 private:
  double Next(double value, double seconds) noexcept override {
    return state_.Next(value, seconds, time_constant.Get());
  }
  void BeginAt(double value) noexcept override { state_.Begin(value); }
  bool is_ramp() const noexcept override { return true; }
  bool has_begun() const noexcept override { return state_.has_begun(); }
  LowPass state_;
};

class RateLimiterFilter final : public Filter {
 public:
  explicit RateLimiterFilter(const Placement& placement) : Filter(placement) { KeepCourse(state_); }
  Parameter<double> rise{this, "rise", {.default_value = 1, .bounds = {0, {}}, .description = "per second at most"}};
  Parameter<double> fall{this, "fall", {.default_value = 1, .bounds = {0, {}}, .description = "per second at most"}};

 private:
  double Next(double value, double seconds) noexcept override {
    return state_.Next(value, seconds, rise.Get(), fall.Get());
  }
  void BeginAt(double value) noexcept override { state_.Begin(value); }
  bool is_ramp() const noexcept override { return true; }
  bool has_begun() const noexcept override { return state_.has_begun(); }
  RateLimiter state_;
};

class DeadBandFilter final : public Filter {
 public:
  using Filter::Filter;
  Parameter<double> width{
      this,
      "width",
      {.default_value = 0.1, .bounds = {0, {}}, .description = "up to which on either side of 0 it is 0"}};

 private:
  double Next(double value, double) noexcept override { return DeadBand(value, width.Get()); }
};

class LinearFilter final : public Filter {
 public:
  using Filter::Filter;
  Parameter<double> gain{this, "gain", {.default_value = 1, .description = "times the value"}};
  Parameter<double> offset{this, "offset", {.description = "is added then"}};

 private:
  double Next(double value, double) noexcept override { return value * gain.Get() + offset.Get(); }
};

}  // namespace runnel::signal
