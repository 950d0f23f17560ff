#include <exception>
#include <utility>

#include "plugins/control/command.h"
#include "plugins/structure/change_history.h"

namespace runnel {

namespace {

constexpr Duration kLookWhetherDone = std::chrono::milliseconds(20);

// What worker and command share; the command may be gone before the worker is done.
struct HistoryState {
  bool goes_back;
  ChangeOutcome outcome = {};
  std::string what = {};
};

void Take(HistoryState& state, const ControlledApplication& application) {
  ChangeHistory& history = *application.history;
  const auto label = state.goes_back ? history.NextUndo() : history.NextRedo();
  try {
    state.outcome = state.goes_back ? history.Undo() : history.Redo();
  } catch (const std::exception& exception) {
    state.outcome.diagnostics.Add({.message = exception.what()});
  }
  if (!label) return;
  state.what = (state.goes_back ? "undone: " : "redone: ") + *label;
  application.log.Add(ControlLog::Kind::kChange,
                      (state.outcome ? "" : "could not be ") + state.what);
}

class HistoryCommand final : public Command {
 public:
  HistoryCommand(bool goes_back, const ControlledApplication& application, ChangeWorker& worker)
      : state_(std::make_shared<HistoryState>(HistoryState{goes_back})),
        job_(worker.Post([state = state_, &application] { Take(*state, application); })) {}
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
  const std::shared_ptr<HistoryState> state_;
  const std::shared_ptr<ChangeWorker::Job> job_;
};

CommandResult Make(bool goes_back, const ControlledApplication& application, ChangeWorker& worker) {
  if (application.history == nullptr) {
    return Error{.message = "the program that runs this application remembers no changes"};
  }
  return std::unique_ptr<Command>(std::make_unique<HistoryCommand>(goes_back, application, worker));
}

}  // namespace

CommandResult MakeUndoCommand(const Request&, const ControlledApplication& application,
                              ChangeWorker& worker) {
  return Make(true, application, worker);
}

CommandResult MakeRedoCommand(const Request&, const ControlledApplication& application,
                              ChangeWorker& worker) {
  return Make(false, application, worker);
}

}  // namespace runnel
