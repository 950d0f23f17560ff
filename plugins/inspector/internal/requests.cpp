#include "plugins/inspector/internal/requests.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <mutex>
#include <utility>

#include "plugins/inspector/internal/json_parts.h"
#include "plugins/structure/change_text.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostErrors = 100;
constexpr std::size_t kMostChanges = 20'000;

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

std::string ApplyChanges(Inspection& inspection, const ViewerMessage& message) {
  const ControlledApplication& application = inspection.application();
  Diagnostics diagnostics;
  if (message.changes.empty()) diagnostics.Add({.message = "there are no changes in it"});
  if (message.changes.size() > kMostChanges) {
    diagnostics.Add({.message = "more than " + std::to_string(kMostChanges) + " changes at once"});
  }
  PlacedChanges placed;
  if (diagnostics.ok()) placed = ParseAll(message.changes, diagnostics);
  if (!diagnostics.ok()) return Refusal(message.request, ErrorsOf(diagnostics));
  LoadMissingPlugins(placed.changes, application);
  const ChangeOutcome outcome = application.editor.Apply(placed.changes, placed.positions);
  std::string log = outcome ? "" : "refused: ";
  for (std::size_t i = 0; i < placed.changes.size(); ++i) {
    log += (i > 0 ? "; " : "") + ChangeText(placed.changes[i]);
    if (log.size() > ControlLog::kLongestText) break;
  }
  application.log.Add(ControlLog::Kind::kChange, std::move(log));
  if (!outcome) return Refusal(message.request, ErrorsOf(outcome.diagnostics));
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "done; threads stood still for %.3f ms",
                ToSeconds(outcome.stood_still) * 1e3);
  std::string all = text.data();
  for (const Error& warning : outcome.diagnostics.warnings()) all += "\n" + warning.ToString();
  return Reply(message.request, all);
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
  if (message.op == "change") return ApplyChanges(inspection, message);
  if (IsOneOf(message.op, {"pause", "resume", "step", "speed"}))
    return SetPace(inspection, message);
  if (message.op == "compatible") return FindCompatible(inspection, message);
  if (message.op == "save") return Call(hooks.save, message.file, "save it", message);
  if (message.op == "reload") {
    return Call(hooks.reload, message.plugin, "load plugins anew", message);
  }
  return Refusal(message.request,
                 {{Error{.message = "this program cannot do '" + message.op + "'"}}});
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

std::string CarryOut(Inspection& inspection, const ViewerMessage& message) {
  try {
    return Do(inspection, message);
  } catch (const std::exception& exception) {
    return Refusal(message.request, {{Error{.message = exception.what()}}});
  }
}

}  // namespace runnel::internal
