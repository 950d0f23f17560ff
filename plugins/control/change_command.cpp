#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "plugins/control/command.h"
#include "plugins/control/element_search.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

constexpr std::size_t kMostChanges = 20'000;
constexpr std::size_t kMostErrors = 100;
constexpr Duration kLookWhetherDone = std::chrono::milliseconds(20);
// A module whose thread runs no cycles never proves itself.
constexpr Duration kLongestProbation = std::chrono::seconds(3);

std::string DiagnosticsText(const Diagnostics& all) {
  Diagnostics shown;
  for (std::size_t i = 0; i < std::min(kMostErrors, all.errors().size()); ++i) {
    shown.Add(all.errors()[i]);
  }
  for (std::size_t i = 0; i < std::min(kMostErrors, all.warnings().size()); ++i) {
    shown.AddWarning(all.warnings()[i]);
  }
  std::string text = shown.ToString();
  if (all.errors().size() > kMostErrors) {
    text += "and " + std::to_string(all.errors().size() - kMostErrors) + " more errors\n";
  }
  return text;
}

// A replaced module, to find out whether the new one is still there a moment later.
struct Swap {
  std::string path;
  std::uint64_t before = 0;  // serial of the old one
  bool is_back = false;
};

// What worker and command share; the command may be gone before the worker is done.
struct ChangeState {
  PlacedChanges placed;
  ChangeOutcome outcome;
  std::vector<Swap> swaps;
  bool is_on_probation = false;
};

std::uint64_t SerialOf(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = FindMeant(runtime, path);
  return found ? (*found)->serial() : 0;
}

std::vector<Swap> SwapsIn(const ChangeSet& changes, Runtime& runtime) {
  std::vector<Swap> swaps;
  for (const Change& each : changes) {
    const auto* const replace = std::get_if<ReplaceModule>(&each);
    if (replace == nullptr || replace->probation_cycles == 0) continue;
    swaps.push_back({replace->path, SerialOf(runtime, replace->path)});
  }
  return swaps;
}

std::string TypeIn(const Change& change) {
  if (const auto* const create = std::get_if<CreateModule>(&change)) return create->type;
  if (const auto* const replace = std::get_if<ReplaceModule>(&change)) return replace->type;
  return {};
}

// The plugin of type "planning/bug1" is called planning.
void LoadMissingPlugins(const ChangeSet& changes, const ControlledApplication& application) {
  if (!application.hooks.load_plugin) return;
  const std::lock_guard lock(application.runtime.structure_mutex());
  for (const Change& change : changes) {
    const std::string type = TypeIn(change);
    const std::size_t slash = type.find('/');
    if (slash == std::string::npos || application.modules.Find(type) != nullptr) continue;
    // If it cannot be loaded, the error that there is no such type names the nearest.
    (void)application.hooks.load_plugin(type.substr(0, slash));
  }
}

void LogOutcome(const ChangeState& state, ControlLog& log) {
  std::string text = state.outcome ? "" : "refused: ";
  for (std::size_t i = 0; i < state.placed.changes.size(); ++i) {
    text += (i > 0 ? "; " : "") + ChangeText(state.placed.changes[i]);
    if (text.size() > ControlLog::kLongestText) break;
  }
  log.Add(ControlLog::Kind::kChange, std::move(text));
}

void Apply(ChangeState& state, const ControlledApplication& application) {
  try {
    LoadMissingPlugins(state.placed.changes, application);
    state.swaps = SwapsIn(state.placed.changes, application.runtime);
    const PlacedChanges& placed = state.placed;
    state.outcome = application.history != nullptr
                        ? application.history->Apply(placed.changes, placed.positions)
                        : application.editor.Apply(placed.changes, placed.positions);
  } catch (const std::exception& exception) {
    state.outcome.is_done = false;
    state.outcome.diagnostics.Add({.message = exception.what()});
  }
  LogOutcome(state, application.log);
  state.is_on_probation = state.outcome && !state.swaps.empty();
}

void LookAfterProbation(ChangeState& state, const ControlledApplication& application) {
  application.editor.Tend();
  state.is_on_probation = application.editor.on_probation() > 0;
  for (Swap& swap : state.swaps) {
    swap.is_back = SerialOf(application.runtime, swap.path) == swap.before;
  }
}

class ChangeCommand final : public Command {
 public:
  ChangeCommand(PlacedChanges placed, const ControlledApplication& application,
                ChangeWorker& worker)
      : application_(application), worker_(worker), state_(std::make_shared<ChangeState>()) {
    state_->placed = std::move(placed);
    Post(Apply);
  }
  ~ChangeCommand() override { job_->Cancel(); }

  std::optional<ControlCode> Continue(Answer& answer) override {
    ContinueIn(kLookWhetherDone);
    if (!job_->is_done()) return {};
    if (!state_->outcome) {
      answer.Complain(DiagnosticsText(state_->outcome.diagnostics));
      return ControlCode::kBadInput;
    }
    if (state_->swaps.empty()) return Conclude(answer);
    if (!std::exchange(has_looked_, true)) until_ = SteadyClock().Now() + kLongestProbation;
    const bool is_back = std::ranges::any_of(state_->swaps, &Swap::is_back);
    if (is_back || (!state_->is_on_probation && has_proved_) || SteadyClock().Now() > until_) {
      return Conclude(answer);
    }
    // Once more after the end: a fault in the last cycle may just be being answered.
    has_proved_ = !state_->is_on_probation;
    Post(LookAfterProbation);
    return {};
  }

 private:
  void Post(void (*what)(ChangeState&, const ControlledApplication&)) {
    job_ = worker_.Post(
        [what, state = state_, &application = application_] { what(*state, application); });
  }

  ControlCode Conclude(Answer& answer) const {
    if (!state_->outcome.diagnostics.warnings().empty()) {
      answer.Complain(DiagnosticsText(state_->outcome.diagnostics));
    }
    bool is_back = false;
    for (const Swap& swap : state_->swaps) {
      if (!swap.is_back) continue;
      is_back = true;
      answer.Complain(ErrorLine({.message = "the new module failed in one of its first cycles; the "
                                            "old one is back",
                                 .path = swap.path,
                                 .hint = "'runnel log' tells what it threw"}));
    }
    if (is_back) return ControlCode::kFailed;
    if (state_->is_on_probation) {
      answer.Complain("the new module has not run all the cycles of its probation yet\n");
    }
    char text[80];
    std::snprintf(text, sizeof text, "done; threads stood still for %.3f ms\n",
                  ToSeconds(state_->outcome.stood_still) * 1e3);
    answer.Write(text);
    return ControlCode::kDone;
  }

  const ControlledApplication& application_;
  ChangeWorker& worker_;
  const std::shared_ptr<ChangeState> state_;
  std::shared_ptr<ChangeWorker::Job> job_;
  bool has_looked_ = false;
  bool has_proved_ = false;
  Time until_{};
};

// Refuses what cannot be read; an answer with all that is wrong.
class RefusedCommand final : public Command {
 public:
  explicit RefusedCommand(std::string text) : text_(std::move(text)) {}
  std::optional<ControlCode> Continue(Answer& answer) override {
    answer.Complain(text_);
    return ControlCode::kBadInput;
  }

 private:
  const std::string text_;
};

}  // namespace

CommandResult MakeChangeCommand(const Request& request, const ControlledApplication& application,
                                ChangeWorker& worker) {
  Diagnostics diagnostics;
  const SourcePosition begins{.file = request.Option("file"), .line = 1, .column = 1};
  PlacedChanges placed = ParseChanges(request.body, begins, diagnostics);
  if (diagnostics.ok() && placed.changes.empty()) {
    diagnostics.Add({.message = "there are no changes in it", .position = begins});
  }
  if (placed.changes.size() > kMostChanges) {
    diagnostics.Add({.message = "more than " + std::to_string(kMostChanges) + " changes at once",
                     .position = begins});
  }
  if (!diagnostics.ok()) {
    return std::unique_ptr<Command>(std::make_unique<RefusedCommand>(DiagnosticsText(diagnostics)));
  }
  return std::unique_ptr<Command>(
      std::make_unique<ChangeCommand>(std::move(placed), application, worker));
}

}  // namespace runnel
