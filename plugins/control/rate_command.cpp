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
  std::uint64_t count;
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

std::string LineOf(const Sample& before, const Sample& now, const std::string& intervals) {
  // A module that was made anew counts from 0 again.
  const std::uint64_t passed = now.count >= before.count ? now.count - before.count : now.count;
  const double simulated = ToSeconds(now.time - before.time);
  const double real = ToSeconds(now.machine - before.machine);
  const auto rate = [&](double seconds) {
    return RateText(seconds > 0 ? static_cast<double>(passed) / seconds : 0) + " Hz";
  };
  const std::string values = ", " + std::to_string(passed) + " values" + intervals + "\n";
  const bool is_real = std::abs(simulated - real) < 0.01 * real;
  return is_real ? rate(real) + values
                 : rate(simulated) + " of the application's time (" + rate(real) +
                       " of real time)" + values;
}

}  // namespace

// Counts at the publisher: nothing is subscribed or copied. Intervals are those of values that are seen one by one, up to
// about 200 Hz.
CommandResult MakeRateCommand(const Request& request, const CommandContext& context) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return Command(UnderLock(
      context.application.runtime,
      [&runtime = context.application.runtime, path = request.arguments[0], left = *count,
       last = std::optional<Sample>(), intervals = Intervals()](Answer& answer) mutable -> CommandStep {
        const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
        if (!found) {
          const ControlCode code = Refuse(answer, found.error());
          return last ? ControlCode::kFailed : code;
        }
        const Port& port = **found;
        const Sample now{port.publications(), runtime.clock().Now(), SteadyClock().Now()};
        for (const auto* const shown : port.ShownPorts()) {
          std::optional<Time> published;
          shown->VisitLatest([&](const void*, ValueTimes times) { published = times.publication_time; });
          if (!published) continue;
          intervals.Add(port.publications(), *published);
          break;
        }
        if (!last) last = now;
        if (now.machine - last->machine < kWindow) return kLookAgain;
        answer.Write(LineOf(*last, now, intervals.Take()));
        if (left && --*left == 0) return ControlCode::kDone;
        last = now;
        return kLookAgain;
      }));
}

}  // namespace runnel
