#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>

#include "core/base/clock.h"
#include "core/element/former_name.h"
#include "core/log/logger.h"
#include "core/port/input.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

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

/// The time-out of an input, as parameter `<input>_timeout`: a value counts if it has come, is no older than that by its
/// stamp, is measured and a number; the safe value of a stop counts as long as that is in force. Why another one does not
/// count it says in the same words in each module, and in the
/// log once for each change.
///
///     Input<Pose2> pose{this, "pose", {.ageing = Ageing::kTimesOut}};
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
      : limit(module, input.name() + "_timeout",
              {.default_value = options.seconds,
               .bounds = {0.0, 3600.0},
               .unit = "s",
               .description = "a value of " + input.name() + " that is older does not count"}),
        log_(options.log),
        counts_from_publication_(options.counts_from_publication) {
    if (options.former_name != nullptr) limit.Annotate(std::make_unique<FormerName>(options.former_name));
    constexpr std::array kWords = {"is there again", "has never come", "is old", "is not measured",
                                   "is not a number"};
    for (std::size_t i = 0; i < texts_.size(); ++i) texts_[i] = input.name() + " " + kWords[i];
  }

  Parameter<double> limit;

  /// Empty: it does not count. `now`: what its age is reckoned from.
  template <typename T>
  [[nodiscard]] Lease<T> Read(Input<T>& input, Time now) {
    const bool is_held = input.is_stop_in_force();  // first: what was old is no news by a press in between
    Lease<T> lease = input.Read();
    const bool is_old = lease && now - (counts_from_publication_ ? lease.publication_time() : lease.timestamp()) >
                                     FromSeconds(limit.Get());
    Note(!lease                ? InputLack::kNeverCame
         : is_old && !is_held ? InputLack::kOld
                              : FindLack(*lease),
         now);
    if (lack_ != InputLack::kNone) return {};
    return lease;
  }
  /// Of the last Read().
  [[nodiscard]] InputLack lack() const noexcept { return lack_; }
  /// "pose is old"; lives as long as this.
  [[nodiscard]] const char* words() const noexcept {
    return texts_[static_cast<std::size_t>(lack_)].c_str();
  }

 private:
  // What has not come yet is told when it should have.
  void Note(InputLack lack, Time now) noexcept {
    if (!began_) began_ = now;
    lack_ = lack;
    if (log_ == nullptr || lack == told_) return;
    if (lack == InputLack::kNeverCame && now - *began_ <= FromSeconds(limit.Get())) return;
    told_ = lack;
    if (lack == InputLack::kNone) {
      log_->Info("{}", std::string_view(words()));
    } else {
      log_->Warn("{}", std::string_view(words()));
    }
  }

  Logger* const log_;
  const bool counts_from_publication_;
  std::array<std::string, 5> texts_;
  std::optional<Time> began_;
  InputLack lack_ = InputLack::kNeverCame;
  InputLack told_ = InputLack::kNone;
};

}  // namespace runnel
