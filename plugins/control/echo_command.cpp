#include <mutex>
#include <vector>

#include <fmt/format.h>

#include "core/lockfree/thread_epoch.h"
#include "core/port/path_search.h"
#include "core/types/type_info.h"
#include "plugins/control/command.h"
#include "plugins/control/value_text.h"

namespace runnel {

namespace {

// A port that publishes while it is looked at may have published the value that is shown, or the next.
constexpr int kLooks = 5;

/// Shows the values of a port one by one, as fast as the client takes them and no faster than
/// kLookAgain. Publishers do not notice: values are leased, and made text here.
class EchoCommand final : public Command {
 public:
  EchoCommand(Runtime& runtime, std::string path, std::optional<std::uint64_t> count, bool is_full)
      : runtime_(runtime),
        path_(std::move(path)),
        left_(count),
        options_(is_full ? FullValueText() : ValueTextOptions{}) {}

  std::optional<ControlCode> Continue(Answer& answer) override {
    ContinueIn(kLookAgain);
    // What is found under the lock stays in memory while the guard is held; so the lock need not be.
    const EpochGuard guard;
    std::unique_lock lock(runtime_.structure_mutex(), std::try_to_lock);
    if (!lock) return {};
    const auto found = PathSearch(runtime_).FindPort(path_, PathKind::kOutput);
    if (!found) {
      answer.WriteError(ErrorLine(found.error()));
      return has_found_ ? ControlCode::kFailed : ControlCode::kBadInput;
    }
    const Port& port = **found;
    if (!port.type().is_transparent()) {
      answer.WriteError(
          ErrorLine({.message = "values of type " + port.type().name() + " have no text format",
                     .path = port.path()}));
      return ControlCode::kBadInput;
    }
    has_found_ = true;
    std::vector<const Port*> sources{&port};
    if (port.is_proxy()) {
      const auto ends = port.Sources();
      sources.assign(ends.begin(), ends.end());
    }
    lock.unlock();
    Show(sources, answer);
    if (left_ && *left_ == 0) return ControlCode::kDone;
    return {};
  }

 private:
  void Show(const std::vector<const Port*>& sources, Answer& answer) {
    std::string text;
    std::uint64_t count = CountOf(sources);
    if (has_shown_ && count == shown_) return;
    for (int i = 0; i < kLooks; ++i) {
      text = TextOf(sources);
      const std::uint64_t after = CountOf(sources);
      if (after == count || i == kLooks - 1) break;
      count = after;
    }
    if (text.empty()) return;
    const std::uint64_t missed = has_shown_ && count > shown_ ? count - shown_ - 1 : 0;
    if (missed > 0) text += "  (" + std::to_string(missed) + " not shown)";
    answer.Write(text + "\n");
    has_shown_ = true;
    shown_ = count;
    if (left_) --*left_;
  }

  [[nodiscard]] static std::uint64_t CountOf(const std::vector<const Port*>& sources) {
    std::uint64_t count = 0;
    for (const Port* source : sources) count += source->publications();
    return count;
  }

  [[nodiscard]] std::string TextOf(const std::vector<const Port*>& sources) const {
    std::string text;
    for (const Port* source : sources) {
      const bool has_value = source->VisitLatest([&](const void* value, Time timestamp) {
        text = fmt::format("{:.3f} s  {}", ToSeconds(timestamp),
                           ValueText(source->type(), value, options_));
      });
      if (has_value) break;
    }
    return text;
  }

  Runtime& runtime_;
  const std::string path_;
  std::optional<std::uint64_t> left_;
  const ValueTextOptions options_;
  bool has_found_ = false;
  bool has_shown_ = false;
  std::uint64_t shown_ = 0;  // the count with the last value
};

}  // namespace

CommandResult MakeEchoCommand(const Request& request, const ServedApplication& application) {
  const auto count = ReadCountOption(request);
  if (!count) return count.error();
  return std::unique_ptr<Command>(std::make_unique<EchoCommand>(
      application.runtime, request.arguments[0], *count, request.Has("full")));
}

}  // namespace runnel
