#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/clock.h"
#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/log/logger.h"
#include "core/port/input.h"
#include "core/port/typed_ports.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

/// Of an input without which a module cannot tell what to do, and which grows old.
inline InputOptions Measured(std::string description) {
  return {.description = std::move(description), .required = true, .ageing = Ageing::kTimesOut};
}

/// The same of one by which something moves.
inline InputOptions Driving(std::string description) {
  return {.description = std::move(description), .required = true, .drives = true, .ageing = Ageing::kTimesOut};
}

/// Why what is at an input does not count.
enum class InputLack { kNone, kNeverCame, kOld, kNotMeasured, kNotANumber };

/// Of a value itself. Types say it by IsMeasured(value) and IsFinite(value) in their own namespace.
template <typename T>
[[nodiscard]] InputLack FindLack(const T& value) {
  if constexpr (requires { IsMeasured(value); }) {
    if (!IsMeasured(value)) return InputLack::kNotMeasured;
  }
  if constexpr (requires { IsFinite(value); }) {
    if (!IsFinite(value)) return InputLack::kNotANumber;
  } else if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) return InputLack::kNotANumber;
  }
  return InputLack::kNone;
}

/// The time-out of an input, as parameter `<input>_timeout`, or that of several which are numbered: in1, in2 … have
/// `in_timeout`. A value counts if it has come, is no older than that by its stamp, is measured and a number; the safe
/// value of a stop counts as long as that is in force. Why another one does not count it says in the same words in each
/// module, and in the log once for each change.
///
///     Input<Pose2> pose{this, "pose", Measured("of the robot")};
///     InputTimeout pose_timeout{this, pose, {.log = &log()}};
///     …
///     const auto here = pose_timeout.Read(pose, now());
///     if (!here) return;
///
/// Threads:     as the module's other members. Allocation: the constructor only.
class InputTimeout {
 public:
  struct Options {
    double seconds = 0.5;
    const char* former_name = nullptr;  ///< of the parameter; nullptr: none
    Logger* log = nullptr;              ///< nullptr: the module itself says what is amiss
    /// From when it was said, not from when anything was measured: of signals that go round, whose measurements never renew.
    bool counts_from_publication = false;
  };
  InputTimeout(FrameworkElement* module, const Port& input, const Options& options)
      : InputTimeout(module, input.name(), options) {}
  /// `inputs`: what their names begin with.
  InputTimeout(FrameworkElement* module, const std::string& inputs, const Options& options)
      : limit(module, inputs + "_timeout",
              {.default_value = options.seconds,
               .bounds = {0.0, 3600.0},
               .unit = "s",
               .description = "a value of " + inputs + " that is older does not count"}),
        options_(options) {
    if (options.former_name != nullptr) limit.Annotate(std::make_unique<FormerName>(options.former_name));
    constexpr std::array kWords = {"is there again", "has never come", "is old", "is not measured", "is not a number"};
    for (std::size_t i = 0; i < texts_.size(); ++i) texts_[i] = inputs + " " + kWords[i];
  }

  Parameter<double> limit;

  /// Empty: it does not count. `now`: what its age is reckoned from.
  template <typename T>
  [[nodiscard]] Lease<T> Read(Input<T>& input, Time now) {
    const bool is_held = input.is_stop_in_force();  // first: what was old is no news by a press in between
    Lease<T> lease = input.Read();
    const bool is_old = lease && !is_held && IsOld(lease.times(), now);
    Note(!lease ? InputLack::kNeverCame : is_old ? InputLack::kOld : FindLack(*lease), now);
    if (lack_ != InputLack::kNone) return {};
    return lease;
  }
  /// The same of a value of any type, into a place, which is empty if it does not count; whether it was new. Nobody asks
  /// whether it is a number.
  bool Read(Port& input, HeldValues& values, std::size_t place) {
    const Time now = input.runtime().clock().Now();
    const bool is_held = static_cast<InputBase&>(input).is_stop_in_force();
    const bool is_new = values.Read(input, place);
    const bool is_there = values.Find(place) != nullptr;
    const bool is_old = is_there && !is_held && IsOld(values.times(place), now);
    Note(is_old ? InputLack::kOld : is_there ? InputLack::kNone : InputLack::kNeverCame, now);
    if (is_old) values.Drop(place);
    return is_new;
  }
  /// Of the last Read().
  [[nodiscard]] InputLack lack() const noexcept { return lack_; }
  /// Nothing has come by then, and it need not have: it has not been looked for any longer.
  [[nodiscard]] bool is_awaited(Time now) const noexcept {
    return lack_ == InputLack::kNeverCame && now - *began_ <= FromSeconds(limit.Get());
  }
  /// "pose is old"; lives as long as this.
  [[nodiscard]] const char* words() const noexcept { return texts_[static_cast<std::size_t>(lack_)].c_str(); }

 private:
  [[nodiscard]] bool IsOld(const ValueTimes& times, Time now) const noexcept {
    const Time said = options_.counts_from_publication ? times.publication_time : times.timestamp;
    return now - said > FromSeconds(limit.Get());
  }
  // What has not come yet is told when it should have.
  void Note(InputLack lack, Time now) noexcept {
    if (!began_) began_ = now;
    lack_ = lack;
    if (options_.log == nullptr || lack == told_ || is_awaited(now)) return;
    told_ = lack;
    if (lack == InputLack::kNone) {
      options_.log->Info("{}", std::string_view(words()));
    } else {
      options_.log->Warn("{}", std::string_view(words()));
    }
  }

  const Options options_;
  std::array<std::string, 5> texts_;
  std::optional<Time> began_;
  InputLack lack_ = InputLack::kNeverCame;
  InputLack told_ = InputLack::kNone;
};

}  // namespace runnel
