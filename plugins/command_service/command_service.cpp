#include "plugins/command_service/command_service.h"

#include <utility>

#include "plugins/command_service/caught_error.h"
#include "plugins/command_service/change_task.h"
#include "plugins/command_service/save_place.h"
#include "plugins/structure/change_history.h"

namespace runnel {

namespace {

template <typename... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};

using Hook = std::function<Result<std::string>(const std::string&)>;

CommandAnswer Call(const Hook& hook, const std::string& argument, const char* what) {
  if (!hook) {
    return CommandAnswer::Refused(
        {.message = std::string("the program that runs this application cannot ") + what});
  }
  const auto done = hook(argument);
  return done ? CommandAnswer::Done(*done) : CommandAnswer::Failed(done.error());
}

}  // namespace

CommandAnswer PendingCommand::Take() {
  if (task_->failure()) return CommandAnswer::Failed(*task_->failure());
  return std::move(*answer_);
}

std::unique_ptr<PendingCommand> CommandService::Begin(CommandRequest request, TaskGroup& tasks,
                                                      std::function<void()> on_done) {
  auto answer = std::make_shared<CommandAnswer>();
  TaskStep step =
      std::visit(Overloaded{[&](ChangeRequest& change) -> TaskStep {
                              return ChangeTask(std::move(change), application_, answer);
                            },
                            [&](const auto& other) -> TaskStep {
                              return [this, other, answer]() -> std::optional<Duration> {
                                *answer = Do(other);
                                return {};
                              };
                            }},
                 request);
  return std::make_unique<PendingCommand>(tasks.PostSteps(std::move(step), std::move(on_done)),
                                          std::move(answer));
}

CommandAnswer CommandService::Do(const UndoRequest&) const { return TakeHistoryStep(true); }
CommandAnswer CommandService::Do(const RedoRequest&) const { return TakeHistoryStep(false); }

CommandAnswer CommandService::Do(const SaveRequest& request) const {
  std::string file = request.file;
  if (request.is_confined && !file.empty()) {
    const auto place = SavePlace(request.application_file, file);
    if (!place) return CommandAnswer::Refused(place.error());
    file = *place;
  }
  return Call(application_.hooks.save, file, "save it");
}

CommandAnswer CommandService::Do(const ReloadRequest& request) const {
  return Call(application_.hooks.reload, request.plugin, "load plugins anew");
}

CommandAnswer CommandService::TakeHistoryStep(bool goes_back) const {
  if (application_.history == nullptr) {
    return CommandAnswer::Refused(
        {.message = "the program that runs this application remembers no changes"});
  }
  ChangeHistory& history = *application_.history;
  const auto label = goes_back ? history.NextUndo() : history.NextRedo();
  CommandAnswer answer;
  try {
    ChangeOutcome outcome = goes_back ? history.Undo() : history.Redo();
    answer.diagnostics = std::move(outcome.diagnostics);
    if (!outcome) answer.outcome = CommandAnswer::Outcome::kRefused;
  } catch (...) {
    answer = CommandAnswer::Failed(CaughtError());
  }
  if (!label) return answer;
  const std::string what = (goes_back ? "undone: " : "redone: ") + *label;
  application_.log.Add(ApplicationLog::Kind::kChange, (answer ? "" : "could not be ") + what);
  if (answer) answer.text = what;
  return answer;
}

}  // namespace runnel
