#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/element/configurable.h"
#include "core/lockfree/thread_epoch.h"
#include "core/paths/path_search.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/control/command.h"
#include "plugins/control/element_listing.h"
#include "plugins/values/watched_port.h"

namespace runnel {

namespace {

constexpr std::size_t kDigits = 6;

bool BelongsToWord(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_' || character == '.';
}

// The length of the number that the text begins with; 0 if it begins with none, or with a whole one.
std::size_t FractionLength(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view read(text.data(), static_cast<std::size_t>(end - text.data()));
  const bool is_fraction = error == std::errc() && read.find_first_of(".e") != read.npos;
  const bool is_word = text.substr(read.size()).starts_with('.');  // as an address is
  return is_fraction && !is_word && read.find_first_not_of("-") == read.find_first_of("0123456789") ? read.size() : 0;
}

Result<void> CheckIsReadable(const Port& port) {
  if (port.type().is_transparent()) return {};
  return Error{.message = "values of type " + port.type().name() + " have no text format", .path = port.path()};
}

// Of a parameter, as `set` takes it. Nothing: the port has had no value yet.
Result<std::optional<std::string>> ValueOf(Runtime& runtime, const std::string& path) {
  const auto parameter = PathSearch(runtime).Find(path, PathKind::kParameter);
  if (parameter) {
    if (const auto* const found = dynamic_cast<const Configurable*>(*parameter)) return std::optional(found->ToText());
  }
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
  if (!found) return parameter ? found.error() : parameter.error();
  const Port& port = **found;
  if (auto readable = CheckIsReadable(port); !readable) return readable.error();
  std::optional<std::string> text;
  for (const Port* source : port.ShownPorts()) source->NoteLook();
  (void)VisitShown(port, [&](const void* value, ValueTimes) { text = ToText(port.type(), value); });
  return text;
}

// By the machine's clock, for what is published only if somebody looks.
constexpr std::chrono::milliseconds kWaitsForValue(500);

constexpr TextLimits kUsual{.elements = 12, .text = 120, .all = 16'000};
constexpr TextLimits kFull{.text = 4'000'000, .all = 4'000'000};

/// Shows the values of a port one by one, as fast as the client takes them and no faster than
/// kLookAgain. Publishers do not notice: values are leased, and made text here.
class Echo {
 public:
  Echo(const ServedApplication& application, std::string path, std::optional<std::uint64_t> count, bool is_full)
      : runtime_(application.runtime),
        zero_(application.log.start()),
        path_(std::move(path)),
        left_(count),
        is_full_(is_full) {}

  CommandStep operator()(Answer& answer) {
    const EpochGuard guard;  // what is found stays in memory so long
    {
      const std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
      if (!lock) return kLookAgain;
      const auto found = Find();
      if (!found) return has_found_ ? Fail(answer, found.error()) : Refuse(answer, found.error());
    }
    has_found_ = true;
    Show(answer);
    if (left_ && *left_ == 0) return ControlCode::kDone;
    return kLookAgain;
  }

 private:
  // Of a value that says when it was measured. In full, all of it: a program finds no text of a value in it.
  [[nodiscard]] std::string Measured(ValueTimes times, std::uint64_t left_out) const {
    const std::string measured = fmt::format("measured at {:.3f} s", ToSeconds(times.timestamp - zero_));
    if (is_full_) return fmt::format("({}, {} not shown)  ", measured, left_out);
    return times.timestamp == times.publication_time ? std::string() : "(" + measured + ")  ";
  }
  Result<void> Find() {
    const auto found = PathSearch(runtime_).FindPort(path_, PathKind::kOutput);
    if (!found) return found.error();
    const Port& port = **found;
    if (auto readable = CheckIsReadable(port); !readable) return readable;
    if (port_ == nullptr || port_->path() != port.path()) {
      port_ = std::make_shared<WatchedPort>(port.path());
    }
    return port_->Find(runtime_);
  }

  void Show(Answer& answer) {
    std::string text;
    ValueTimes measured;
    const auto count = port_->VisitIfNew([&](const void* value, ValueTimes times) {
      text = ToText(port_->type(), value, is_full_ ? kFull : kUsual);
      measured = times;
    });
    if (!count && !shown_ && !std::exchange(has_said_nothing_, true)) {
      answer.WriteError(port_->path() + ": nothing has been published there yet; waits\n");
    }
    if (!count) return;
    const std::uint64_t left_out = shown_ && *count > *shown_ ? *count - *shown_ - 1 : 0;
    const std::string more = left_out > 0 && !is_full_ ? fmt::format("  ({} not shown)", left_out) : "";
    answer.Write(fmt::format("{:.3f} s  {}{}{}\n", ToSeconds(measured.publication_time - zero_),
                             Measured(measured, left_out), is_full_ ? text : ReadableNumbers(text), more));
    shown_ = count;
    if (left_) --*left_;
  }

  Runtime& runtime_;
  const Time zero_;
  const std::string path_;
  std::optional<std::uint64_t> left_;
  const bool is_full_;
  bool has_said_nothing_ = false;  // told, that is
  std::shared_ptr<WatchedPort> port_;
  bool has_found_ = false;
  std::optional<std::uint64_t> shown_;  // the count with the last value
};

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

std::string ReadableNumbers(std::string_view text) {
  std::string readable;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t length = 1;
    if (text[at] == '"') {
      while (at + length < text.size() && text[at + length] != '"') length += text[at + length] == '\\' ? 2 : 1;
      length = std::min(length + 1, text.size() - at);
    } else if (const std::size_t number = FractionLength(text.substr(at)); number > 0) {
      const std::string word(text.substr(at, number));
      if (number > kDigits + 1) {
        readable += fmt::format("{:.{}g}", std::strtod(word.c_str(), nullptr), kDigits);
      } else {
        readable += word;
      }
      at += number;
      continue;
    } else {
      while (BelongsToWord(text[at]) && at + length < text.size() && BelongsToWord(text[at + length])) ++length;
    }
    readable += text.substr(at, length);
    at += length;
  }
  return readable;
}

CommandResult MakeGetCommand(const Request& request, const CommandContext& context) {
  Runtime& runtime = context.application.runtime;
  return Command(UnderLock(runtime,
                           [&runtime, path = request.arguments[0], is_full = request.Has("full"),
                            until = std::chrono::steady_clock::now() + kWaitsForValue](Answer& answer) -> CommandStep {
                             const auto value = ValueOf(runtime, path);
                             if (!value) return Refuse(answer, value.error());
                             if (!*value && std::chrono::steady_clock::now() < until) return kLookAgain;
                             if (!*value)
                               return Refuse(answer, {.message = "nothing has been published there yet", .path = path});
                             return Say(answer, (is_full ? **value : ReadableNumbers(**value)) + "\n");
                           }));
}

CommandResult MakeEchoCommand(const Request& request, const CommandContext& context) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return Command(Echo(context.application, request.arguments[0], *count, request.Has("full")));
}

// Looks at the publisher: nothing is subscribed or copied. Intervals are those of values that are seen one by one, up to
// about 200 Hz.
CommandResult MakeRateCommand(const Request& request, const CommandContext& context) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return Command(UnderLock(context.application.runtime,
                           [&runtime = context.application.runtime, path = request.arguments[0], left = *count,
                            last = std::optional<Sample>(), rate = PublicationRate(),
                            intervals = Intervals()](Answer& answer) mutable -> CommandStep {
                             const auto found = PathSearch(runtime).FindPort(path, PathKind::kOutput);
                             if (!found) return last ? Fail(answer, found.error()) : Refuse(answer, found.error());
                             const Sample now{Publications::Of(**found), runtime.clock().Now(), SteadyClock().Now()};
                             if (now.publications.newest)
                               intervals.Add(now.publications.count, *now.publications.newest);
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
