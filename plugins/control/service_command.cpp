#include <algorithm>
#include <utility>

#include "core/paths/distant_ports.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/command_service/request_table.h"
#include "plugins/control/command.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

constexpr std::size_t kMostErrors = 100;
constexpr const char* kClient = "a terminal";

// Of what is in another application.
bool IsFar(const Change& change) {
  if (const auto* const set = std::get_if<SetParameter>(&change)) return IsDistantPath(set->path);
  const auto* const swap = std::get_if<ReplaceModule>(&change);
  return swap != nullptr && IsDistantPath(swap->path);
}

PlacedChanges ReadChanges(const Request& request, Diagnostics& diagnostics) {
  const SourcePosition begins{request.Option("file"), 1, 1};
  PlacedChanges placed = ParseChanges(request.body, begins, diagnostics);
  if (diagnostics.ok() && placed.changes.empty()) {
    diagnostics.Add({.message = "there are no changes in it", .position = begins});
  }
  if (placed.changes.size() > ChangeRequest::kMostChanges) {
    diagnostics.Add({.message = "more than " + std::to_string(ChangeRequest::kMostChanges) + " changes at once",
                     .position = begins});
  }
  return placed;
}

// "/robot=debug", or "debug" for all.
RequestFields LevelOf(const std::string& wish) {
  const std::size_t equals = wish.rfind('=');
  if (equals == std::string::npos) return {{"level", wish}};
  return {{"path", wish.substr(0, equals)}, {"level", wish.substr(equals + 1)}};
}

// One of those that every client offers: words are its fields, in their order.
Result<CommandRequest> DescribedRequestOf(const DescribedRequest& described, const Request& request) {
  RequestFields fields;
  for (const auto& [name, value] : request.options) fields[name] = value;
  for (std::size_t i = 0; i < std::min(described.fields.size(), request.arguments.size()); ++i) {
    fields[std::string(described.fields[i].name)] = request.arguments[i];
  }
  if (request.command == "release" && request.arguments.empty()) fields["path"] = std::string(kRobotStopName);
  return MakeRequest(described.name, fields, kClient);
}

Result<CommandRequest> RequestOf(const Request& request, PlacedChanges placed) {
  if (request.command == "save") {
    return CommandRequest(SaveRequest{.file = request.arguments.empty() ? "" : request.arguments[0],
                                      .is_configuration = request.Option("config") == "yes",
                                      .overwrites = request.Option("overwrite") == "yes"});
  }
  if (request.command == "log") return MakeRequest("log", LevelOf(request.Option("level")), kClient);
  if (request.command == "change") {
    return CommandRequest(ChangeRequest{
        .placed = std::move(placed), .client = kClient, .may_end_application = request.Option("yes") == "yes"});
  }
  const auto described = FindRequest(request.command);
  return described ? DescribedRequestOf(**described, request) : described.error();
}

}  // namespace

// Has the service carry out the request, and tells what has come of it.
CommandResult MakeServiceCommand(const Request& request, const CommandContext& context) {
  PlacedChanges placed;
  if (request.command == "change") {
    Diagnostics diagnostics;
    placed = ReadChanges(request, diagnostics);
    if (!diagnostics.ok()) {
      return Command([text = DiagnosticsText(diagnostics)](Answer& answer) -> CommandStep {
        answer.WriteError(text);
        return ControlCode::kBadInput;
      });
    }
  }
  if (placed.changes.size() == 1 && IsFar(placed.changes.front())) {
    const auto known = context.application.runtime.robot_stop().CheckIsKnown({.asked = context.asked, .requests = {}});
    if (!known) return known.error();
    return ShowExtensionText(context.application.runtime, "command", request.body, ExtensionTexts::kFarPatience);
  }
  auto wanted = RequestOf(request, std::move(placed));
  if (!wanted) return wanted.error();
  const std::shared_ptr<PendingCommand> pending =
      context.service.Begin(std::move(*wanted), context.tasks, {}, {.asked = context.asked, .requests = {}});
  return Command([pending](Answer& answer) -> CommandStep {
    if (!pending->is_done()) return std::shared_ptr<const WorkerTask>(pending->task());
    const CommandAnswer done = pending->Take();
    const std::string diagnostics = DiagnosticsText(done.diagnostics);
    if (!diagnostics.empty()) answer.WriteError(diagnostics);
    if (done.outcome == CommandAnswer::Outcome::kRefused) return ControlCode::kBadInput;
    if (done.outcome == CommandAnswer::Outcome::kFailed) return ControlCode::kFailed;
    answer.Write(done.text + "\n");
    return done.stops_nothing || done.leaves_some ? ControlCode::kFailed : ControlCode::kDone;
  });
}

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

}  // namespace runnel
