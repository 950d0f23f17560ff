#include "plugins/control/client_change.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <mutex>
#include <utility>

#include "plugins/control/element_search.h"
#include "plugins/scheduling/pace.h"
#include "plugins/structure/change_history.h"

namespace runnel {

namespace {

// A module whose thread runs no cycles never proves itself.
constexpr Duration kLongestProbation = std::chrono::seconds(3);

std::uint64_t SerialOf(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = FindMeant(runtime, path);
  return found ? (*found)->serial() : 0;
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

}  // namespace

ClientChange::ClientChange(PlacedChanges placed, std::string label,
                           const ControlledApplication& application, ChangeWorker& worker)
    : application_(application), worker_(worker), state_(std::make_shared<State>()) {
  state_->placed = std::move(placed);
  state_->label = std::move(label);
  Post(Apply);
}

ClientChange::~ClientChange() { job_->Cancel(); }

void ClientChange::Post(void (*what)(State&, const ControlledApplication&)) {
  job_ = worker_.Post(
      [what, state = state_, &application = application_] { what(*state, application); });
}

bool ClientChange::Continue() {
  if (!job_->is_done()) return false;
  if (!state_->outcome || state_->swaps.empty()) return true;
  if (!std::exchange(has_looked_, true)) until_ = SteadyClock().Now() + kLongestProbation;
  const bool is_back = std::ranges::any_of(state_->swaps, &Swap::is_back);
  if (is_back || (!state_->is_on_probation && has_proved_) || SteadyClock().Now() > until_) {
    return true;
  }
  // Nothing proves itself while time stands still.
  const bool is_paused = application_.pace != nullptr && application_.pace->is_paused();
  if (is_paused && state_->is_on_probation) return true;
  // Once more after the end: a fault in the last cycle may just be being answered.
  has_proved_ = !state_->is_on_probation;
  Post(LookAfterProbation);
  return false;
}

const ChangeOutcome& ClientChange::outcome() const { return state_->outcome; }
bool ClientChange::is_on_probation() const { return state_->is_on_probation; }

std::vector<Error> ClientChange::SwappedBack() const {
  std::vector<Error> errors;
  for (const Swap& swap : state_->swaps) {
    if (!swap.is_back) continue;
    errors.push_back(
        {.message = "the new module failed in one of its first cycles; the old one is back",
         .path = swap.path,
         .hint = "'runnel log' tells what it threw"});
  }
  return errors;
}

std::string ClientChange::DoneText() const {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "done; threads stood still for %.3f ms",
                ToSeconds(state_->outcome.stood_still) * 1e3);
  return text.data();
}

std::vector<ClientChange::Swap> ClientChange::SwapsIn(const ChangeSet& changes, Runtime& runtime) {
  std::vector<Swap> swaps;
  for (const Change& each : changes) {
    const auto* const replace = std::get_if<ReplaceModule>(&each);
    if (replace == nullptr || replace->probation_cycles == 0) continue;
    swaps.push_back({replace->path, SerialOf(runtime, replace->path)});
  }
  return swaps;
}

void ClientChange::Log(const State& state, ControlLog& log) {
  std::string text = state.outcome ? "" : "refused: ";
  for (std::size_t i = 0; i < state.placed.changes.size(); ++i) {
    text += (i > 0 ? "; " : "") + ChangeText(state.placed.changes[i]);
    if (text.size() > ControlLog::kLongestText) break;
  }
  log.Add(ControlLog::Kind::kChange, std::move(text));
}

void ClientChange::Apply(State& state, const ControlledApplication& application) {
  try {
    LoadMissingPlugins(state.placed.changes, application);
    state.swaps = SwapsIn(state.placed.changes, application.runtime);
    const PlacedChanges& placed = state.placed;
    state.outcome = application.history != nullptr
                        ? application.history->Apply(placed.changes, placed.positions, state.label)
                        : application.editor.Apply(placed.changes, placed.positions);
  } catch (const std::exception& exception) {
    state.outcome.is_done = false;
    state.outcome.diagnostics.Add({.message = exception.what()});
  }
  Log(state, application.log);
  state.is_on_probation = state.outcome && !state.swaps.empty();
}

void ClientChange::LookAfterProbation(State& state, const ControlledApplication& application) {
  application.editor.Tend();
  state.is_on_probation = application.editor.on_probation() > 0;
  for (Swap& swap : state.swaps) {
    swap.is_back = SerialOf(application.runtime, swap.path) == swap.before;
  }
}

}  // namespace runnel
