#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/paths/path_search.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"

namespace runnel {

namespace {

constexpr Duration kWindow = std::chrono::seconds(1);

struct Sample {
  Publications publications;
  Time time;     // of the application
  Time machine;  // of the machine
};

/// The times between values, as far as each of them is seen.
class Intervals {
 public:
  // `count`: published by then.
  void Add(std::uint64_t count, Time time) {
    if (last_ && count == last_->first + 1) {
      const double seconds = ToSeconds(time - last_->second);
      ++seen_;
      sum_ += seconds;
      squares_ += seconds * seconds;
      least_ = seen_ == 1 ? seconds : std::min(least_, seconds);
      most_ = std::max(most_, seconds);
    }
    last_ = {count, time};
  }
  // Since the last call.
  std::string Take() {
    std::string text;
    if (seen_ > 1) {
      const double mean = sum_ / static_cast<double>(seen_);
      const double jitter = std::sqrt(std::max(0.0, squares_ / static_cast<double>(seen_) - mean * mean));
      text = fmt::format(", every {:.4g} ms (min {:.4g}, max {:.4g}, jitter {:.3g})", mean * 1e3, least_ * 1e3,
                         most_ * 1e3, jitter * 1e3);
    }
    seen_ = 0;
    sum_ = squares_ = least_ = most_ = 0;
    return text;
  }

 private:
  std::optional<std::pair<std::uint64_t, Time>> last_;
  std::uint64_t seen_ = 0;
  double sum_ = 0;
  double squares_ = 0;
  double least_ = 0;
  double most_ = 0;
};

// `hertz`: of the application's time.
std::string LineOf(const Sample& before, const Sample& now, double hertz, const std::string& intervals) {
  // A module that was made anew counts from 0 again.
  const std::uint64_t count = now.publications.count;
  const std::uint64_t passed = count >= before.publications.count ? count - before.publications.count : count;
  const double simulated = ToSeconds(now.time - before.time);
  const double real = ToSeconds(now.machine - before.machine);
  std::string text = RateText(hertz) + " Hz";
  if (std::abs(simulated - real) >= 0.01 * real) {
    text += " of the application's time (" + RateText(hertz * simulated / real) + " Hz of real time)";
  }
  return text + ", " + std::to_string(passed) + " values" + intervals + "\n";
}

}  // namespace

// Looks at the publisher: nothing is subscribed or copied. Intervals are those of values that are seen one by one, up to
// about 200 Hz.
CommandResult MakeRateCommand(const Request& request, const CommandContext& context) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return Command(UnderLock(
      context.application.runtime,
      [&runtime = context.application.runtime, path = request.arguments[0], left = *count,
       last = std::optional<Sample>(), rate = PublicationRate(), intervals = Intervals()](Answer& answer) mutable -> CommandStep {
        const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
        if (!found) return last ? Fail(answer, found.error()) : Refuse(answer, found.error());
        const Sample now{Publications::Of(**found), runtime.clock().Now(), SteadyClock().Now()};
        if (now.publications.newest) intervals.Add(now.publications.count, *now.publications.newest);
        if (last && now.machine - last->machine < kWindow) return kLookAgain;
        const double hertz = rate.Look(now.publications, now.time);
        const auto before = std::exchange(last, now);
        if (!before) return kLookAgain;
        answer.Write(LineOf(*before, now, hertz, intervals.Take()));
        if (left && --*left == 0) return ControlCode::kDone;
        return kLookAgain;
      }));
}

}  // namespace runnel
