#include "plugins/command_service/change_task.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/erase_where.h"
#include "core/element/attempt.h"
#include "core/element/configurable.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "plugins/scheduling/pace.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

// A module whose thread runs no cycles never proves itself, and never says whether it takes a value.
constexpr Duration kLongestProbation = std::chrono::seconds(3);
// How long after one look at the new modules the next one comes.
constexpr Duration kLookAgain = std::chrono::milliseconds(5);

std::uint64_t IdOf(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).Find(path);
  return found ? (*found)->id() : 0;
}

// The application that the changes would delete, as a whole; "" if none.
std::string DeletedApplication(Runtime& runtime, const ChangeSet& changes) {
  const std::lock_guard lock(runtime.structure_mutex());
  for (const Change& change : changes) {
    const auto* const each = std::get_if<DeleteElement>(&change);
    if (each == nullptr) continue;
    const auto found = PathSearch(runtime).Find(each->path);
    if (found && (*found)->parent() == &runtime.root() && (*found)->kind() == ElementKind::kGroup &&
        (*found)->name() != "threads") {
      return (*found)->path();
    }
  }
  return {};
}

// `room` for all that is said of what was done.
constexpr std::size_t kRoomForText = 160;
std::string DoneText(Duration hold_time, std::string room) {
  const auto text =
      fmt::format_to_n(room.data(), room.size(), "done; threads stood still for {:.3f} ms", ToSeconds(hold_time) * 1e3);
  room.resize(text.size);
  return room;
}

// Of what is logged, what it means; "" of other changes.
std::string MeaningOf(const ChangeSet& changes, Runtime& runtime) {
  const auto* const log = changes.size() == 1 ? std::get_if<LogElement>(&changes.front()) : nullptr;
  if (log == nullptr) return {};
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).Find(log->path);
  return (found && log->path != "/" ? (*found)->path() : log->path) +
         (log->level ? ": logs " + LogLevelName(*log->level) + " and more" : ": logs as what is around it");
}

// As the history will call it when it is undone, and what that is.
std::string EntryOf(const ChangeSet& changes, const std::string& label) {
  std::string text;
  for (const Change& each : changes) {
    text += (text.empty() ? "" : "; ") + ChangeText(each);
    if (text.size() > ApplicationLog::kLongestText) break;
  }
  return label.empty() ? text : label + ": " + text;
}

// What makes the module anew, or those below that have failed. Errors: nothing is there to be made anew.
Result<ChangeSet> MadeAnew(const ServedApplication& application, const std::string& path) {
  std::vector<std::pair<std::string, std::string>> modules;  // paths and types
  bool is_module = false;
  {
    const std::lock_guard lock(application.runtime.structure_mutex());
    const auto found = PathSearch(application.runtime).Find(path);
    if (!found) return found.error();
    is_module = IsModule(**found);
    if (!is_module && (*found)->kind() != ElementKind::kGroup) {
      return Error{.message = "is neither a module nor a group, and cannot be restarted", .path = (*found)->path()};
    }
    (*found)->Visit([&](FrameworkElement& each) {
      if (IsModule(each) && (!is_module || &each == *found)) modules.emplace_back(each.path(), FindModuleType(each));
    });
  }
  ChangeSet changes;
  for (const auto& [module, type] : modules) {
    const auto progress = application.scheduler != nullptr ? application.scheduler->ProgressOf(module) : std::nullopt;
    const bool is_wanted = is_module || (progress && progress->has_failed);
    if (is_wanted) changes.push_back(ReplaceModule{module, type});
  }
  if (!changes.empty()) return changes;
  return Error{.message = "nothing in it has failed", .path = path, .hint = "name the module that is to be made anew"};
}

// A replaced module, to find out whether the new one is still there a moment later.
struct Swap {
  std::string path;
  std::uint64_t before = 0;  // id of the old one
  bool is_back = false;
};

struct ChangeTask {
  std::optional<Duration> Step();
  [[nodiscard]] bool IsMeant();
  void Apply();
  void FindSwaps();
  void LookAfterProbation();
  void LookAtSettings();
  [[nodiscard]] bool IsOver() const;
  void Conclude();

  ChangeRequest request;
  const ServedApplication& application;
  const std::shared_ptr<CommandAnswer> answer;
  const RobotStop::AsOf as_of;
  const std::string made_anew;
  std::vector<Swap> swaps = {};
  std::vector<std::string> settings = {};  // paths of parameters, until their modules have said what they make of it
  bool has_begun = false;
  bool is_on_probation = false;
  bool has_proved = false;
  std::chrono::steady_clock::time_point until{};  // when the wait for the proof is given up
};

std::optional<Duration> ChangeTask::Step() {
  if (!std::exchange(has_begun, true)) {
    if (!IsMeant()) return {};
    Apply();
    until = std::chrono::steady_clock::now() + (is_on_probation ? kLongestProbation : kLongestSetting);
  }
  // Once more after the end: a fault in the last cycle may just be being answered.
  has_proved = !is_on_probation;
  try {
    if (!swaps.empty()) LookAfterProbation();
    LookAtSettings();
  } catch (const std::bad_alloc&) {  // it has been done all the same; there may be memory at the next look
    has_proved = false;
  }
  if (!IsOver()) return kLookAgain;
  Conclude();
  return {};
}

// Nothing brings a deleted application back: its run ends. What is made anew is known only now.
bool ChangeTask::IsMeant() {
  if (const auto known = application.runtime.robot_stop().CheckIsKnown(as_of); !known) {
    *answer = CommandAnswer::Refused(known.error());
    return false;
  }
  if (!made_anew.empty()) {
    auto changes = MadeAnew(application, made_anew);
    if (!changes) *answer = CommandAnswer::Refused(changes.error());
    if (!changes) return false;
    request.placed.changes = std::move(*changes);
    request.label = "restart " + made_anew;
  }
  if (request.may_end_application) return true;
  const std::string deleted = DeletedApplication(application.runtime, request.placed.changes);
  if (deleted.empty()) return true;
  *answer = CommandAnswer::Asks({.message = "is the whole application: deleting it ends its run, and cannot be undone",
                                 .path = deleted,
                                 .hint = "say --yes if that is meant"},
                                "yes");
  return false;
}

// What the answer and the log need comes first: nothing may fail between doing it and saying that it is done.
void ChangeTask::Apply() {
  const PlacedChanges& placed = request.placed;
  std::string entry = EntryOf(placed.changes, request.label);
  std::string text(kRoomForText, ' ');
  std::string meaning = MeaningOf(placed.changes, application.runtime);
  ChangeOutcome outcome;
  try {
    if (application.hooks.load_plugins) application.hooks.load_plugins(placed.changes);
    FindSwaps();
    outcome = application.history != nullptr
                  ? application.history->Apply(placed.changes, placed.positions, request.label, request.client, as_of)
                  : application.editor.Apply(placed.changes, placed.positions, as_of);
    answer->outcome = outcome ? CommandAnswer::Outcome::kDone : CommandAnswer::Outcome::kRefused;
    answer->diagnostics = std::move(outcome.diagnostics);
  } catch (...) {
    *answer = CommandAnswer::Failed(CaughtError());
  }
  is_on_probation = *answer && !swaps.empty();
  if (!*answer) settings.clear(), swaps.clear();
  if (*answer) answer->text = meaning.empty() ? DoneText(outcome.hold_time, std::move(text)) : std::move(meaning);
  application.log.Add(ApplicationLog::Kind::kChange, *answer ? std::move(entry) : "refused: " + entry);
}

void ChangeTask::FindSwaps() {
  for (const Change& each : request.placed.changes) {
    const auto* const replace = std::get_if<ReplaceModule>(&each);
    if (const auto* const set = std::get_if<SetParameter>(&each)) settings.push_back(set->path);
    if (replace == nullptr || replace->probation_cycles == 0) continue;
    swaps.push_back({replace->path, IdOf(application.runtime, replace->path)});
  }
}

void ChangeTask::LookAtSettings() {
  EraseWhere(settings, [this](const std::string& path) {
    const auto said = OutcomeOf(application.runtime, path);
    if (said && !*said) answer->diagnostics.Add(said->error()), answer->outcome = CommandAnswer::Outcome::kFailed;
    return said.has_value();
  });
}

void ChangeTask::LookAfterProbation() {
  application.editor.Tend();
  is_on_probation = application.editor.on_probation() > 0;
  for (Swap& swap : swaps) {
    swap.is_back = IdOf(application.runtime, swap.path) == swap.before;
  }
}

bool ChangeTask::IsOver() const {
  if (std::ranges::any_of(swaps, &Swap::is_back)) return true;
  if (!is_on_probation && settings.empty()) return has_proved;
  // Nothing proves itself while time stands still.
  if (application.pace != nullptr && application.pace->is_paused()) return true;
  return std::chrono::steady_clock::now() > until;
}

void ChangeTask::Conclude() {
  for (const Swap& swap : swaps) {
    if (!swap.is_back) continue;
    answer->outcome = CommandAnswer::Outcome::kFailed;
    answer->diagnostics.Add({.message = "the new module failed in one of its first cycles; the old one is back",
                             .path = swap.path,
                             .hint = "'runnel log' tells what it threw"});
  }
  if (*answer && is_on_probation) {
    answer->text += "\nthe new module has not run all the cycles of its probation yet";
  }
}

}  // namespace

std::optional<Result<void>> OutcomeOf(Runtime& runtime, std::string_view path) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).Find(path, PathKind::kParameter);
  const auto* const parameter = found ? dynamic_cast<const Configurable*>(*found) : nullptr;
  return parameter != nullptr ? parameter->Outcome() : Result<void>();
}

TaskStep ChangeSteps(ChangeRequest request, const ServedApplication& application, std::shared_ptr<CommandAnswer> answer,
                     const RobotStop::AsOf& as_of, std::string made_anew) {
  const auto task = std::make_shared<ChangeTask>(
      ChangeTask{std::move(request), application, std::move(answer), as_of, std::move(made_anew)});
  return [task] { return task->Step(); };
}

}  // namespace runnel
