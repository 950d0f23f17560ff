#include <cmath>
#include <optional>

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

std::string LineOf(const Sample& before, const Sample& now) {
  // A module that was made anew counts from 0 again.
  const std::uint64_t passed = now.count >= before.count ? now.count - before.count : now.count;
  const double simulated = ToSeconds(now.time - before.time);
  const double real = ToSeconds(now.machine - before.machine);
  const auto rate = [&](double seconds) {
    return RateText(seconds > 0 ? static_cast<double>(passed) / seconds : 0) + " Hz";
  };
  const std::string values = ", " + std::to_string(passed) + " values\n";
  const bool is_real = std::abs(simulated - real) < 0.01 * real;
  return is_real ? rate(real) + values
                 : rate(simulated) + " of the application's time (" + rate(real) +
                       " of real time)" + values;
}

}  // namespace

// Counts at the publisher: nothing is subscribed, read or copied.
CommandResult MakeRateCommand(const Request& request, const CommandContext& context) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return Command(UnderLock(
      context.application.runtime,
      [&runtime = context.application.runtime, path = request.arguments[0], left = *count,
       last = std::optional<Sample>()](Answer& answer) mutable -> CommandStep {
        const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
        if (!found) {
          const ControlCode code = Refuse(answer, found.error());
          return last ? ControlCode::kFailed : code;
        }
        const Sample now{(*found)->publications(), runtime.clock().Now(), SteadyClock().Now()};
        if (last) {
          answer.Write(LineOf(*last, now));
          if (left && --*left == 0) return ControlCode::kDone;
        }
        last = now;
        return kWindow;
      }));
}

}  // namespace runnel
