#include "plugins/inspector/internal/requests.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <utility>
#include <variant>

#include "core/paths/path_search.h"
#include "plugins/command_service/save_place.h"
#include "plugins/inspector/internal/call_request.h"
#include "plugins/inspector/internal/conversion_request.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostErrors = 100;

void AppendError(const RequestError& each, std::string& text) {
  JsonObject json(text);
  json.Add("message", each.error.message);
  json.AddTextOrNull("path", each.error.path);
  json.AddTextOrNull("hint", each.error.hint);
  json.AddOrNull("change", each.change);
}

void AddHead(std::optional<std::uint64_t> request, bool is_ok, JsonObject& json) {
  json.Add("op", "reply").AddOrNull("request", request).Add("ok", is_ok);
}

bool IsOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

// Each change is a line of its own in the places, so that errors say which it is.
std::vector<RequestError> ErrorsOf(const Diagnostics& diagnostics) {
  std::vector<RequestError> errors;
  for (const Error& error : diagnostics.errors()) {
    if (errors.size() == kMostErrors) break;
    RequestError each{error, {}};
    if (error.position.line > 0) each.change = static_cast<std::size_t>(error.position.line - 1);
    errors.push_back(std::move(each));
  }
  return errors;
}

std::string ReplyTo(std::optional<std::uint64_t> request, const CommandAnswer& answer) {
  if (!answer) return Refusal(request, ErrorsOf(answer.diagnostics), answer.needs);
  std::string text = answer.text;
  for (const Error& warning : answer.diagnostics.warnings()) text += "\n" + warning.ToString();
  if (answer.client.empty()) return Reply(request, text);
  return JsonObjectText([&](JsonObject& json) {
    AddHead(request, true, json);
    json.Add("text", text).Add("client", answer.client);
  });
}

using CommandOrErrors = std::variant<CommandRequest, std::vector<RequestError>>;

CommandOrErrors ReadChanges(ViewerMessage& message) {
  using Errors = std::vector<RequestError>;
  if (!message.wrong_changes.empty()) {
    message.wrong_changes.resize(std::min(message.wrong_changes.size(), kMostErrors));
    return std::move(message.wrong_changes);
  }
  if (message.changes.empty()) return Errors{{Error{.message = "there are no changes in it"}}};
  if (message.changes.size() > ChangeRequest::kMostChanges) {
    return Errors{{Error{.message = "more than " + std::to_string(ChangeRequest::kMostChanges) +
                                    " changes at once"}}};
  }
  ChangeRequest request{{.changes = std::move(message.changes), .positions = {}},
                        std::move(message.label), std::move(message.client), message.may_end_application};
  for (std::size_t i = 0; i < request.placed.changes.size(); ++i) {
    request.placed.positions.push_back({"changes", static_cast<int>(i + 1), 1});
  }
  return CommandRequest(std::move(request));
}

// What the service is to be asked for.
CommandOrErrors CommandOf(const Inspection& inspection, ViewerMessage& message) {
  if (message.op == "change") return ReadChanges(message);
  if (message.op == "undo") return CommandRequest(UndoRequest{});
  if (message.op == "redo") return CommandRequest(RedoRequest{});
  if (message.op == "reload") return CommandRequest(ReloadRequest{message.plugin});
  if (message.op == "restart") return CommandRequest(RestartRequest{message.path});
  if (message.op == "stop") return CommandRequest(QuitRequest{});
  if (message.op == "pause") return CommandRequest(PauseRequest{message.path, true});
  if (message.op == "resume") return CommandRequest(PauseRequest{message.path, false});
  if (message.op == "log_level") return CommandRequest(LogLevelRequest{message.path, message.level});
  if (message.op == "release") return CommandRequest(ReleaseRequest{message.path});
  if (message.op == "publish" && message.is_stop) return CommandRequest(BlockRequest{message.path});
  if (message.op == "publish") {
    PublishRequest publish{message.path, message.value, message.rate};
    // Of what no duration can hold the service says so.
    if (message.deadline) publish.deadline = FromSeconds(std::min(*message.deadline, 1e6));
    publish.lease = message.lease;
    return CommandRequest(std::move(publish));
  }
  return CommandRequest(SaveRequest{
      .file = message.file,
      .is_confined = true,
      .application_file = inspection.options().file,
      .is_configuration = message.what == "configuration",
      .overwrites = message.overwrites});
}

std::string FindCompatible(Inspection& inspection, const ViewerMessage& message) {
  const auto catalogue = inspection.catalogue();
  if (catalogue == nullptr) {
    return Refusal(message.request, {{Error{.message = "the module types are still being looked at",
                                            .hint = "ask again in a moment"}}});
  }
  const auto types = CompatibleTypes(inspection.application().runtime, *catalogue, message.path);
  if (!types) return Refusal(message.request, {{types.error()}});
  return JsonObjectText([&](JsonObject& json) {
    AddHead(message.request, true, json);
    json.AddJson("types", *types);
  });
}

std::string ReadPanel(Inspection& inspection, const ViewerMessage& message) {
  const auto text = inspection.panel().Read();
  if (!text) return Refusal(message.request, {{text.error()}});
  return JsonObjectText([&](JsonObject& json) {
    AddHead(message.request, true, json);
    json.Add("text", *text).AddTextOrNull("file", inspection.panel().file().string());
  });
}

std::string SavePanel(Inspection& inspection, const ViewerMessage& message) {
  const auto done = inspection.panel().Save(message.value);
  if (!done) return Refusal(message.request, {{done.error()}});
  inspection.application().log.Add(ApplicationLog::Kind::kChange, *done);
  return Reply(message.request, *done);
}

std::string PreviewSave(Inspection& inspection, const ViewerMessage& message) {
  std::string file = message.file;
  if (!file.empty()) {
    const auto place = SavePlace(inspection.options().file, file);
    if (!place) return Refusal(message.request, {{place.error()}});
    file = *place;
  }
  const auto& preview_save = inspection.application().hooks.preview_save;
  if (!preview_save) {
    return Refusal(message.request,
                   {{Error{.message = "the program that runs this application cannot save it"}}});
  }
  const auto difference = preview_save(file);
  if (!difference) return Refusal(message.request, {{difference.error()}});
  return JsonObjectText([&](JsonObject& json) {
    AddHead(message.request, true, json);
    json.Add("file", difference->file);
    json.Add("before", difference->before).Add("after", difference->after);
  });
}

std::string SetLatency(Inspection& inspection, const ViewerMessage& message) {
  const LatencyRequest latency{message.from, message.to};
  Scheduler& scheduler = inspection.scheduler();
  const auto done =
      message.is_on ? scheduler.AddLatency(latency) : scheduler.RemoveLatency(latency);
  return done ? Reply(message.request, "done") : Refusal(message.request, {{done.error()}});
}

// What the worker does for this viewer alone, because it may wait.
std::string AnswerOf(Inspection& inspection, const ViewerMessage& message) {
  if (message.op == "abort") return AbortCall(inspection, message);
  if (message.op == "panel") return ReadPanel(inspection, message);
  if (message.op == "save_panel") return SavePanel(inspection, message);
  if (message.op == "latency") return SetLatency(inspection, message);
  if (message.op == "preview") return PreviewSave(inspection, message);
  if (message.op == "conversions") return FindConversions(inspection, message);
  return FindCompatible(inspection, message);
}

std::string SetPace(Inspection& inspection, const ViewerMessage& message) {
  Pace& pace = inspection.scheduler().pace();
  Result<void> done;
  if (message.op == "pause") {
    done = pace.Pause();
  } else if (message.op == "resume") {
    done = pace.Resume();
  } else if (message.op == "step") {
    done = pace.StepCycles(message.cycles);
  } else if (!message.speed) {
    done = Error{.message = "the speed is missing",
                 .hint = "\"speed\": 1 is real time, 0 as fast as it can"};
  } else {
    done = pace.SetSpeed(*message.speed);
  }
  return done ? Reply(message.request, "done") : Refusal(message.request, {{done.error()}});
}

// At once for all viewers; the reply comes when it has been written.
ViewerRequest Arrange(Inspection& inspection, const ViewerMessage& message,
                      std::function<void()> on_done) {
  const auto request = message.request;
  const auto done = inspection.arrangement().Change(message.entries);
  if (!done) return {nullptr, [reply = Refusal(request, {{done.error()}})] { return reply; }};
  const std::string file = Arrangement::FileOf(inspection.options().file);
  if (file.empty()) return {nullptr, [reply = Reply(request, "kept while it runs")] { return reply; }};
  const auto reply = std::make_shared<std::string>();
  auto task = inspection.tasks().Post(
      [reply, request, file, text = inspection.arrangement().Text()] {
        const auto written = Arrangement::Write(file, text);
        *reply = written ? Reply(request, "kept in " + file) : Refusal(request, {{written.error()}});
      },
      std::move(on_done));
  return {task, [request, reply, task = task.get()] {
            return task->failure() ? Refusal(request, {{*task->failure()}}) : *reply;
          }};
}

// Saved into another file, it looks there as it does here.
void CopyArrangement(Inspection& inspection, const std::string& wanted) {
  const auto place = SavePlace(inspection.options().file, wanted);
  const std::string text = inspection.arrangement().Text();
  if (!place || text.empty() || *place == inspection.options().file) return;
  inspection.tasks().Post([file = Arrangement::FileOf(*place), text] {
    (void)Arrangement::Write(file, text);  // what matters has been saved
  });
}

}  // namespace

std::string Reply(std::optional<std::uint64_t> request, const std::string& text) {
  return JsonObjectText([&](JsonObject& json) {
    AddHead(request, true, json);
    json.Add("text", text);
  });
}

std::string Refusal(std::optional<std::uint64_t> request, const std::vector<RequestError>& errors,
                    const std::string& needs) {
  return JsonObjectText([&](JsonObject& json) {
    AddHead(request, false, json);
    if (!needs.empty()) json.Add("needs", needs);
    AppendList(errors, json.Key("errors"), AppendError);
  });
}

std::span<const Operation> AllOperations() {
  using enum Operation::Kind;
  using enum WebRole;
  static constexpr std::array kAll{
      Operation("watch", kTold, kLook),
      Operation("unwatch", kTold, kLook),
      Operation("watch_rates", kTold, kLook),
      Operation("compatible", kRequest, kLook),
      Operation("conversions", kRequest, kLook),
      Operation("panel", kRequest, kLook),
      Operation("publish", kRequest, kDrive),
      Operation("release", kRequest, kDrive),
      Operation("call", kRequest, kDrive),
      Operation("abort", kRequest, kDrive),
      // Who drives may stop all of it and let it go on, but not leave out one module, which may be what
      // keeps the robot from colliding.
      Operation("pause", kRequest, kDrive, kChange),
      Operation("resume", kRequest, kDrive, kChange),
      Operation("change", kRequest, kChange),
      Operation("undo", kRequest, kChange),
      Operation("redo", kRequest, kChange),
      Operation("save", kRequest, kChange),
      Operation("save_panel", kRequest, kChange),
      Operation("arrange", kRequest, kChange),
      Operation("step", kRequest, kChange),
      Operation("speed", kRequest, kChange),
      Operation("reload", kRequest, kChange),
      Operation("log_level", kRequest, kChange),
      Operation("profile", kRequest, kChange),
      Operation("latency", kRequest, kChange),
      Operation("preview", kRequest, kChange),
      Operation("restart", kRequest, kChange),
      Operation("stop", kRequest, kChange)};
  return kAll;
}

const Operation* FindOperation(std::string_view name) {
  const auto found = std::ranges::find(AllOperations(), name, &Operation::name);
  return found == AllOperations().end() ? nullptr : &*found;
}

WebRole RoleFor(const Operation& operation, const ViewerMessage& message) {
  return message.path.empty() ? operation.role
                              : std::max(operation.role, operation.role_of_modules);
}

ViewerRequest BeginRequest(Inspection& inspection, ViewerMessage message,
                           std::function<void()> on_done) {
  const auto request = message.request;
  // At once, whatever the worker is waiting for.
  if (message.op == "profile") {
    inspection.scheduler().SetProfiled(message.is_on);
    return {nullptr, [reply = Reply(request, "done")] { return reply; }};
  }
  if (message.path.empty() && IsOneOf(message.op, {"pause", "resume", "step", "speed"})) {
    return {nullptr, [reply = SetPace(inspection, message)] { return reply; }};
  }
  if (message.op == "call") return BeginCallRequest(inspection, message);
  if (IsOneOf(message.op, {"abort", "compatible", "conversions", "latency", "panel", "preview", "save_panel"})) {
    const auto reply = std::make_shared<std::string>();
    auto task = inspection.tasks().Post(
        [&inspection, reply, message = std::move(message)] {
          *reply = AnswerOf(inspection, message);
        },
        std::move(on_done));
    return {task, [request, reply, task = task.get()] {
              return task->failure() ? Refusal(request, {{*task->failure()}}) : *reply;
            }};
  }
  if (message.op == "arrange") return Arrange(inspection, message, std::move(on_done));
  const std::string copy = message.op == "save" && message.what.empty() ? message.file : "";
  auto command = CommandOf(inspection, message);
  if (const auto* const errors = std::get_if<std::vector<RequestError>>(&command)) {
    return {nullptr, [reply = Refusal(request, *errors)] { return reply; }};
  }
  const std::shared_ptr<PendingCommand> pending = inspection.service().Begin(
      std::move(std::get<CommandRequest>(command)), inspection.tasks(), std::move(on_done));
  return {pending->task(), [&inspection, request, pending, copy] {
            const CommandAnswer answer = pending->Take();
            if (answer && !copy.empty()) CopyArrangement(inspection, copy);
            return ReplyTo(request, answer);
          }};
}

}  // namespace runnel::internal
