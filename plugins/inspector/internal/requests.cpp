#include "plugins/inspector/internal/requests.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <utility>

#include "plugins/control/client_change.h"
#include "plugins/control/history_step.h"
#include "plugins/inspector/internal/json_parts.h"
#include "plugins/inspector/internal/save_place.h"
#include "plugins/structure/change_text.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostErrors = 100;

void AppendError(const RequestError& each, std::string& text) {
  JsonObject json(text);
  json.Add("message", each.error.message);
  AddTextOrNull("path", each.error.path, json);
  AddTextOrNull("hint", each.error.hint, json);
  if (each.change) {
    json.Add("change", *each.change);
  } else {
    AddNull("change", json);
  }
}

void AddHead(std::optional<std::uint64_t> request, bool is_ok, JsonObject& json) {
  json.Add("op", "reply");
  if (request) {
    json.Add("request", *request);
  } else {
    AddNull("request", json);
  }
  json.Add("ok", is_ok);
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

PlacedChanges ParseAll(const std::vector<std::string>& texts, Diagnostics& diagnostics) {
  PlacedChanges all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const SourcePosition place{.file = "changes", .line = static_cast<int>(i + 1), .column = 1};
    PlacedChanges one = ParseChanges(texts[i], place, diagnostics);
    if (diagnostics.ok() && one.changes.size() != 1) {
      diagnostics.Add({.message = one.changes.empty() ? "there is no change in it"
                                                      : "this is more than one change",
                       .position = place});
    }
    for (Change& change : one.changes) {
      all.changes.push_back(std::move(change));
      all.positions.push_back(place);
    }
  }
  return all;
}

// What others do in a thread that may wait.
class WorkerRequest final : public ViewerRequest {
 public:
  WorkerRequest(ChangeWorker& worker, std::function<std::string()> work)
      : reply_(std::make_shared<std::string>()),
        job_(worker.Post([reply = reply_, work = std::move(work)] { *reply = work(); })) {}
  ~WorkerRequest() override { job_->Cancel(); }

  std::optional<std::string> Continue() override {
    if (!job_->is_done()) return {};
    return std::move(*reply_);
  }

 private:
  const std::shared_ptr<std::string> reply_;
  const std::shared_ptr<ChangeWorker::Job> job_;
};

class ChangeRequest final : public ViewerRequest {
 public:
  ChangeRequest(std::optional<std::uint64_t> request, PlacedChanges placed, std::string label,
                Inspection& inspection)
      : request_(request),
        change_(std::move(placed), std::move(label), inspection.application(),
                inspection.worker()) {}

  std::optional<std::string> Continue() override {
    if (!change_.Continue()) return {};
    const ChangeOutcome& outcome = change_.outcome();
    if (!outcome) return Refusal(request_, ErrorsOf(outcome.diagnostics));
    std::vector<RequestError> errors;
    for (Error& error : change_.SwappedBack()) errors.push_back({std::move(error)});
    if (!errors.empty()) return Refusal(request_, errors);
    std::string text = change_.DoneText();
    if (change_.is_on_probation()) {
      text += "\nthe new module has not run all the cycles of its probation yet";
    }
    for (const Error& warning : outcome.diagnostics.warnings()) text += "\n" + warning.ToString();
    return Reply(request_, text);
  }

 private:
  const std::optional<std::uint64_t> request_;
  ClientChange change_;
};

// One that has been answered before it began.
class AnsweredRequest final : public ViewerRequest {
 public:
  explicit AnsweredRequest(std::string reply) : reply_(std::move(reply)) {}
  std::optional<std::string> Continue() override { return reply_; }

 private:
  const std::string reply_;
};

std::unique_ptr<ViewerRequest> BeginChange(Inspection& inspection, ViewerMessage message) {
  Diagnostics diagnostics;
  if (message.changes.empty()) diagnostics.Add({.message = "there are no changes in it"});
  if (message.changes.size() > ClientChange::kMostChanges) {
    diagnostics.Add({.message = "more than " + std::to_string(ClientChange::kMostChanges) +
                                " changes at once"});
  }
  PlacedChanges placed;
  if (diagnostics.ok()) placed = ParseAll(message.changes, diagnostics);
  if (!diagnostics.ok()) {
    return std::make_unique<AnsweredRequest>(Refusal(message.request, ErrorsOf(diagnostics)));
  }
  return std::make_unique<ChangeRequest>(message.request, std::move(placed),
                                         std::move(message.label), inspection);
}

std::string TakeStep(Inspection& inspection, const ViewerMessage& message) {
  if (inspection.application().history == nullptr) {
    return Refusal(message.request, {{Error{.message = "the program that runs this application "
                                                       "remembers no changes"}}});
  }
  const HistoryStep step = TakeHistoryStep(inspection.application(), message.op == "undo");
  if (!step.outcome) return Refusal(message.request, ErrorsOf(step.outcome.diagnostics));
  return Reply(message.request, step.what);
}

using Hook = std::function<Result<std::string>(const std::string&)>;

std::string Call(const Hook& hook, const std::string& word, const char* what,
                 const ViewerMessage& message) {
  if (!hook) {
    const Error error{.message =
                          std::string("the program that runs this application cannot ") + what};
    return Refusal(message.request, {{error}});
  }
  const auto done = hook(word);
  if (!done) return Refusal(message.request, {{done.error()}});
  return Reply(message.request, *done);
}

std::string Save(Inspection& inspection, const ViewerMessage& message) {
  const Hook& hook = inspection.application().hooks.save;
  if (message.file.empty()) return Call(hook, "", "save it", message);
  const auto place = SavePlace(inspection.options().file, message.file);
  if (!place) return Refusal(message.request, {{place.error()}});
  return Call(hook, *place, "save it", message);
}

std::string FindCompatible(Inspection& inspection, const ViewerMessage& message) {
  const auto catalogue = inspection.catalogue();
  if (catalogue == nullptr) {
    return Refusal(message.request, {{Error{.message = "the module types are still being looked at",
                                            .hint = "ask again in a moment"}}});
  }
  const auto types = CompatibleTypes(inspection.application().runtime, *catalogue, message.path);
  if (!types) return Refusal(message.request, {{types.error()}});
  std::string text;
  {
    JsonObject json(text);
    AddHead(message.request, true, json);
    json.AddJson("types", *types);
  }
  return text;
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

std::string Do(Inspection& inspection, const ViewerMessage& message) {
  const ControlHooks& hooks = inspection.application().hooks;
  if (IsOneOf(message.op, {"undo", "redo"})) return TakeStep(inspection, message);
  if (message.op == "compatible") return FindCompatible(inspection, message);
  if (message.op == "save") return Save(inspection, message);
  return Call(hooks.reload, message.plugin, "load plugins anew", message);
}

}  // namespace

std::string Reply(std::optional<std::uint64_t> request, const std::string& text) {
  std::string reply;
  {
    JsonObject json(reply);
    AddHead(request, true, json);
    json.Add("text", text);
  }
  return reply;
}

std::string Refusal(std::optional<std::uint64_t> request, const std::vector<RequestError>& errors) {
  std::string reply;
  {
    JsonObject json(reply);
    AddHead(request, false, json);
    AppendList(errors, json.Key("errors"), AppendError);
  }
  return reply;
}

const std::vector<std::string>& AllOperations() {
  static const std::vector<std::string> all{
      "watch", "unwatch", "watch_rates", "change", "undo",  "redo",  "compatible",
      "save",  "pause",   "resume",      "step",   "speed", "reload"};
  return all;
}

bool IsRequest(const std::string& op) {
  const auto found = std::ranges::find(AllOperations(), op);
  return found - AllOperations().begin() >= 3 && found != AllOperations().end();
}

bool OnlyLooks(const std::string& op) { return op == "compatible"; }

std::unique_ptr<ViewerRequest> BeginRequest(Inspection& inspection, ViewerMessage message) {
  if (message.op == "change") return BeginChange(inspection, std::move(message));
  // At once, whatever the worker is waiting for.
  if (IsOneOf(message.op, {"pause", "resume", "step", "speed"})) {
    return std::make_unique<AnsweredRequest>(SetPace(inspection, message));
  }
  return std::make_unique<WorkerRequest>(
      inspection.worker(), [&inspection, message = std::move(message)] {
        try {
          return Do(inspection, message);
        } catch (const std::exception& exception) {
          return Refusal(message.request, {{Error{.message = exception.what()}}});
        }
      });
}

}  // namespace runnel::internal
