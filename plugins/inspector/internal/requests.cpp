#include "plugins/inspector/internal/requests.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>
#include <variant>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "plugins/command_service/request_table.h"
#include "plugins/command_service/save_place.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostErrors = 100;
constexpr std::size_t kLongestText = 5000;  // of an error, which may repeat what its client has said

void AppendError(const RequestError& each, std::string& text) {
  JsonObject json(text);
  json.Add("message", Shortened(each.error.message, kLongestText));
  json.AddTextOrNull("path", Shortened(each.error.path, kLongestText));
  json.AddTextOrNull("hint", Shortened(each.error.hint, kLongestText));
  json.AddOrNull("change", each.change);
}

void AddHead(std::optional<std::uint64_t> request, bool is_ok, JsonObject& json) {
  json.Add("op", "reply").AddOrNull("request", request).Add("ok", is_ok);
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
  return JsonObjectText([&](JsonObject& json) {
    AddHead(request, true, json);
    json.Add("text", text);
    if (!answer.client.empty()) json.Add("client", answer.client);
    if (answer.stops_nothing) json.Add("stops_nothing", true);
    if (answer.leaves_some) json.Add("leaves_some", true);
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
    return Errors{{Error{.message = "more than " + std::to_string(ChangeRequest::kMostChanges) + " changes at once"}}};
  }
  ChangeRequest request{{.changes = std::move(message.changes), .positions = {}},
                        std::move(message.label),
                        std::move(message.client),
                        message.may_end_application};
  for (std::size_t i = 0; i < request.placed.changes.size(); ++i) {
    request.placed.positions.push_back({"changes", static_cast<int>(i + 1), 1});
  }
  return CommandRequest(std::move(request));
}

// By the table: its fields are members of the message.
CommandOrErrors MakeDescribed(ViewerMessage& message) {
  RequestFields fields;
  const std::map<std::string_view, const std::string*> texts{{"path", &message.path},
                                                             {"value", &message.value},
                                                             {"lease", &message.lease},
                                                             {"plugin", &message.plugin},
                                                             {"level", &message.level}};
  for (const RequestField& field : FindRequest(message.op).value()->fields) {
    const auto text = texts.find(field.name);
    const auto number = field.name == "rate"       ? message.rate
                        : field.name == "deadline" ? message.deadline
                                                   : std::nullopt;
    if (number) fields.emplace(field.name, *number);
    if (text != texts.end() && (field.is_required || !text->second->empty())) fields.emplace(field.name, *text->second);
  }
  auto made = MakeRequest(message.op, fields, message.client);
  if (auto* const publish = made ? std::get_if<PublishRequest>(&*made) : nullptr) publish->received = message.received;
  return made ? CommandOrErrors(std::move(*made)) : std::vector<RequestError>{{made.error()}};
}

std::string FindCompatible(Inspection& inspection, const ViewerMessage& message) {
  const auto catalogue = inspection.catalogue();
  if (catalogue == nullptr) {
    return Refusal(message.request,
                   {{Error{.message = "the module types are still being looked at", .hint = "ask again in a moment"}}});
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
    return Refusal(message.request, {{Error{.message = "the program that runs this application cannot save it"}}});
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
  const auto done = message.is_on ? scheduler.AddLatency(latency) : scheduler.RemoveLatency(latency);
  return done ? Reply(message.request, "done") : Refusal(message.request, {{done.error()}});
}

std::string SetPace(Inspection& inspection, const ViewerMessage& message) {
  Pace& pace = inspection.scheduler().pace();
  Result<void> done;
  if (LetsMove(message.op)) done = inspection.application().runtime.robot_stop().CheckIsKnown(message.as_of);
  if (!done) return Refusal(message.request, {{done.error()}});
  if (message.op == "pause") {
    done = pace.Pause();
  } else if (message.op == "resume") {
    done = pace.Resume();
  } else if (message.op == "step") {
    done = pace.StepCycles(message.cycles);
  } else if (!message.speed) {
    done = Error{.message = "the speed is missing", .hint = "\"speed\": 1 is real time, 0 as fast as it can"};
  } else {
    done = pace.SetSpeed(*message.speed);
  }
  return done ? Reply(message.request, "done") : Refusal(message.request, {{done.error()}});
}

ViewerRequest Answered(std::string reply) {
  return {[reply = std::move(reply)] { return reply; }};
}

// By the worker, because it may wait.
ViewerRequest AnsweredLater(Inspection& inspection, std::optional<std::uint64_t> request,
                            std::function<std::string()> answer, std::function<void()> on_done) {
  const auto reply = std::make_shared<std::string>();
  auto task = inspection.tasks().Post([reply, answer = std::move(answer)] { *reply = answer(); }, std::move(on_done));
  return {[request, reply, task] { return task->failure() ? Refusal(request, {{*task->failure()}}) : *reply; },
          [task] { return task->is_done(); }};
}

// At once for all viewers; the reply comes when it has been written.
ViewerRequest Arrange(Inspection& inspection, ViewerMessage message, std::function<void()> on_done) {
  const auto request = message.request;
  const auto done = inspection.arrangement().Change(message.entries);
  if (!done) return Answered(Refusal(request, {{done.error()}}));
  const std::string file = Arrangement::FileOf(inspection.options().file);
  if (file.empty()) return Answered(Reply(request, "kept while it runs"));
  auto write = [request, file, text = inspection.arrangement().Text()] {
    const auto written = Arrangement::Write(file, text);
    return written ? Reply(request, "kept in " + file) : Refusal(request, {{written.error()}});
  };
  return AnsweredLater(inspection, request, std::move(write), std::move(on_done));
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

ViewerRequest BeginCommand(Inspection& inspection, const ViewerMessage& message, CommandOrErrors command,
                           std::function<void()> on_done) {
  const auto request = message.request;
  if (const auto* const errors = std::get_if<std::vector<RequestError>>(&command))
    return Answered(Refusal(request, *errors));
  const std::string copy = message.op == "save" && !message.saves_configuration ? message.file : "";
  const std::shared_ptr<PendingCommand> pending = inspection.service().Begin(
      std::move(std::get<CommandRequest>(command)), inspection.tasks(), std::move(on_done), message.as_of);
  return {[&inspection, request, pending, copy] {
            const CommandAnswer answer = pending->Take();
            if (answer && !copy.empty()) CopyArrangement(inspection, copy);
            return ReplyTo(request, answer);
          },
          [pending] { return pending->is_done(); }};
}

// How an operation is carried out: by the service, which is asked for what `kMake` makes of the message.
template <auto kMake>
ViewerRequest ByService(Inspection& inspection, ViewerMessage message, std::function<void()> on_done) {
  return BeginCommand(inspection, message, kMake(message), std::move(on_done));
}

// For this viewer alone.
template <auto kAnswer>
ViewerRequest ByWorker(Inspection& inspection, ViewerMessage message, std::function<void()> on_done) {
  const auto request = message.request;
  auto answer = [&inspection, message = std::move(message)] { return kAnswer(inspection, message); };
  return AnsweredLater(inspection, request, std::move(answer), std::move(on_done));
}

// At once, whatever the worker is waiting for.
template <auto kAnswer>
ViewerRequest AtOnce(Inspection& inspection, ViewerMessage message, std::function<void()> /*on_done*/) {
  return Answered(kAnswer(inspection, message));
}

// Of all of it at once, of modules by the service.
ViewerRequest PauseOrResume(Inspection& inspection, ViewerMessage message, std::function<void()> on_done) {
  const auto begin = message.path.empty() ? AtOnce<SetPace> : ByService<MakeDescribed>;
  return begin(inspection, std::move(message), std::move(on_done));
}

ViewerRequest Save(Inspection& inspection, ViewerMessage message, std::function<void()> on_done) {
  return BeginCommand(inspection, message,
                      CommandRequest(SaveRequest{.file = message.file,
                                                 .is_confined = true,
                                                 .application_file = inspection.options().file,
                                                 .is_configuration = message.saves_configuration,
                                                 .overwrites = message.overwrites}),
                      std::move(on_done));
}

std::string SetProfiled(Inspection& inspection, const ViewerMessage& message) {
  inspection.scheduler().SetProfiled(message.is_on);
  return Reply(message.request, "done");
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
  using enum WebRole;
  // clang-format off
  static const std::array all{
      Operation("watch", kLook, nullptr, "path rate elements as"), Operation("unwatch", kLook, nullptr, "path"),
      Operation("watch_rates", kLook, nullptr, "rate"), Operation("alive", kLook, nullptr),
      Operation("compatible", kLook, ByWorker<FindCompatible>, "path"),
      Operation("conversions", kLook, ByWorker<FindConversions>, "from to"),
      Operation("panel", kLook, ByWorker<ReadPanel>),
      Operation("stop", ByService<MakeDescribed>), Operation("release", ByService<MakeDescribed>),
      Operation("block", ByService<MakeDescribed>), Operation("publish", ByService<MakeDescribed>),
      Operation("call", BeginCallRequest, "path value"), Operation("abort", kDrive, ByWorker<AbortCall>, "path"),
      Operation("pause", PauseOrResume), Operation("resume", PauseOrResume),
      Operation("change", ByService<ReadChanges>, "label changes yes"), Operation("undo", ByService<MakeDescribed>),
      Operation("redo", ByService<MakeDescribed>), Operation("save", Save, "file what overwrite"),
      Operation("save_panel", kChange, ByWorker<SavePanel>, "value"), Operation("arrange", kChange, Arrange, "entries"),
      Operation("step", AtOnce<SetPace>, "cycles"), Operation("speed", AtOnce<SetPace>, "speed"),
      Operation("reload", ByService<MakeDescribed>), Operation("log", ByService<MakeDescribed>),
      Operation("profile", kChange, ByWorker<SetProfiled>, "on"), Operation("latency", kChange, ByWorker<SetLatency>, "from to on"),
      Operation("preview", kChange, ByWorker<PreviewSave>, "file"), Operation("restart", ByService<MakeDescribed>),
      Operation("quit", ByService<MakeDescribed>)};
  // clang-format on
  return all;
}

Operation::Operation(std::string_view its_name, Begin its_begin, std::string_view its_fields)
    : Operation(its_name, WebRole::kChange, its_begin, its_fields) {
  const DescribedRequest& described = *FindRequest(its_name).value();
  role_of_modules = WebRoleNamed(described.role).value();
  role = described.role_of_whole.empty() ? role_of_modules : WebRoleNamed(described.role_of_whole).value();
}

const Operation* FindOperation(std::string_view name) {
  const auto found = std::ranges::find(AllOperations(), name, &Operation::name);
  return found == AllOperations().end() ? nullptr : &*found;
}

Result<void> CheckFields(const Operation& operation, const ViewerMessage& message) {
  if (operation.name == "stop") return {};
  std::istringstream words("op request at " + std::string(operation.fields));
  std::vector<std::string> known(std::istream_iterator<std::string>(words), {});
  if (const auto described = FindRequest(operation.name)) {
    for (const RequestField& field : (*described)->fields) known.emplace_back(field.name);
  }
  for (const std::string& name : message.fields) {
    if (std::ranges::find(known, name) != known.end()) continue;
    return Error{.message = "'" + message.op + "' has no \"" + name + "\"", .hint = NearestNameHint(name, known)};
  }
  return {};
}

WebRole RoleFor(const Operation& operation, const ViewerMessage& message) {
  return message.path.empty() ? operation.role : operation.role_of_modules;
}

}  // namespace runnel::internal
