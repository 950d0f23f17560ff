#include <algorithm>
#include <utility>
#include <vector>

#include "plugins/control/client_change.h"
#include "plugins/control/command.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

constexpr std::size_t kMostErrors = 100;

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

class ChangeCommand final : public Command {
 public:
  ChangeCommand(PlacedChanges placed, const ControlledApplication& application,
                ChangeWorker& worker)
      : change_(std::move(placed), "", application, worker) {}

  std::optional<ControlCode> Continue(Answer& answer) override {
    ContinueIn(ClientChange::kLookWhetherOver);
    if (!change_.Continue()) return {};
    const ChangeOutcome& outcome = change_.outcome();
    if (!outcome || !outcome.diagnostics.warnings().empty()) {
      answer.Complain(DiagnosticsText(outcome.diagnostics));
    }
    if (!outcome) return ControlCode::kBadInput;
    const auto errors = change_.SwappedBack();
    for (const Error& error : errors) answer.Complain(ErrorLine(error));
    if (!errors.empty()) return ControlCode::kFailed;
    if (change_.is_on_probation()) {
      answer.Complain("the new module has not run all the cycles of its probation yet\n");
    }
    answer.Write(change_.DoneText() + "\n");
    return ControlCode::kDone;
  }

 private:
  ClientChange change_;
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
  if (placed.changes.size() > ClientChange::kMostChanges) {
    diagnostics.Add(
        {.message = "more than " + std::to_string(ClientChange::kMostChanges) + " changes at once",
         .position = begins});
  }
  if (!diagnostics.ok()) {
    return std::unique_ptr<Command>(std::make_unique<RefusedCommand>(DiagnosticsText(diagnostics)));
  }
  return std::unique_ptr<Command>(
      std::make_unique<ChangeCommand>(std::move(placed), application, worker));
}

}  // namespace runnel
