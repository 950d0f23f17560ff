#include <exception>
#include <utility>

#include "plugins/control/command.h"
#include "plugins/control/history_step.h"
#include "plugins/structure/change_history.h"

namespace runnel {

namespace {

constexpr Duration kLookWhetherDone = std::chrono::milliseconds(20);

class HistoryCommand final : public Command {
 public:
  HistoryCommand(bool goes_back, const ControlledApplication& application, ChangeWorker& worker)
      : state_(std::make_shared<HistoryStep>()),
        job_(worker.Post([state = state_, &application, goes_back] {
          *state = TakeHistoryStep(application, goes_back);
        })) {}
  ~HistoryCommand() override { job_->Cancel(); }

  std::optional<ControlCode> Continue(Answer& answer) override {
    ContinueIn(kLookWhetherDone);
    if (!job_->is_done()) return {};
    const std::string diagnostics = state_->outcome.diagnostics.ToString();
    if (!diagnostics.empty()) answer.Complain(diagnostics);
    if (!state_->outcome) return ControlCode::kBadInput;
    answer.Write(state_->what + "\n");
    return ControlCode::kDone;
  }

 private:
  const std::shared_ptr<HistoryStep> state_;
  const std::shared_ptr<ChangeWorker::Job> job_;
};

CommandResult Make(bool goes_back, const ControlledApplication& application, ChangeWorker& worker) {
  if (application.history == nullptr) {
    return Error{.message = "the program that runs this application remembers no changes"};
  }
  return std::unique_ptr<Command>(std::make_unique<HistoryCommand>(goes_back, application, worker));
}

}  // namespace

HistoryStep TakeHistoryStep(const ControlledApplication& application, bool goes_back) {
  ChangeHistory& history = *application.history;
  const auto label = goes_back ? history.NextUndo() : history.NextRedo();
  HistoryStep step;
  try {
    step.outcome = goes_back ? history.Undo() : history.Redo();
  } catch (const std::exception& exception) {
    step.outcome.diagnostics.Add({.message = exception.what()});
  }
  if (!label) return step;
  step.what = (goes_back ? "undone: " : "redone: ") + *label;
  application.log.Add(ControlLog::Kind::kChange, (step.outcome ? "" : "could not be ") + step.what);
  return step;
}

CommandResult MakeUndoCommand(const Request&, const ControlledApplication& application,
                              ChangeWorker& worker) {
  return Make(true, application, worker);
}

CommandResult MakeRedoCommand(const Request&, const ControlledApplication& application,
                              ChangeWorker& worker) {
  return Make(false, application, worker);
}

}  // namespace runnel
