#include <cmath>
#include <mutex>

#include "core/port/path_search.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"

namespace runnel {

namespace {

constexpr Duration kWindow = std::chrono::seconds(1);

/// Counts at the publisher: nothing is subscribed, read or copied.
class RateCommand final : public Command {
 public:
  RateCommand(Runtime& runtime, std::string path, std::optional<std::uint64_t> count)
      : runtime_(runtime), path_(std::move(path)), left_(count) {}

  std::optional<ControlCode> Continue(Answer& answer) override {
    std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock) {
      ContinueIn(kLookAgain);
      return {};
    }
    const auto found = PathSearch(runtime_).FindPort(path_, PathKind::kOutput);
    if (!found) {
      answer.WriteError(ErrorLine(found.error()));
      return last_ ? ControlCode::kFailed : ControlCode::kBadInput;
    }
    const Sample now{(*found)->publications(), runtime_.clock().Now(), SteadyClock().Now()};
    lock.unlock();
    if (last_) {
      answer.Write(LineOf(*last_, now));
      if (left_ && --*left_ == 0) return ControlCode::kDone;
    }
    last_ = now;
    ContinueIn(kWindow);
    return {};
  }

 private:
  struct Sample {
    std::uint64_t count;
    Time time;     // of the application
    Time machine;  // of the machine
  };

  static std::string LineOf(const Sample& before, const Sample& now) {
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

  Runtime& runtime_;
  const std::string path_;
  std::optional<std::uint64_t> left_;
  std::optional<Sample> last_;
};

}  // namespace

CommandResult MakeRateCommand(const Request& request, const ServedApplication& application) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return std::unique_ptr<Command>(
      std::make_unique<RateCommand>(application.runtime, request.arguments[0], *count));
}

}  // namespace runnel
