#include "plugins/command_service/request_table.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/types/duration_text.h"
#include "plugins/structure/change_fields.h"

namespace runnel {

namespace {

using Kind = RequestField::Kind;

constexpr std::array kPublishFields{
    RequestField{"path", Kind::kText, true, "the port"},
    RequestField{"value", Kind::kValue, true, "in the text format of its type"},
    RequestField{"rate", Kind::kNumber, false, "publishes it again so often, in Hz"},
    RequestField{"deadline", Kind::kDuration, false,
                 "if no new value comes within this time, the safe value is used until release"},
    RequestField{"lease", Kind::kText, false,
                 "a name for one hold of a key or stick: a value of a hold that has ended is refused"}};
constexpr std::array kReleaseFields{
    RequestField{"path", Kind::kText, true, "the port; or the word 'stop', for the STOP of the robot"}};
constexpr std::array kBlockFields{RequestField{"path", Kind::kText, true, "the port"}};
constexpr std::array kPauseFields{RequestField{"path", Kind::kText, true, "a module, a group or a thread"}};
constexpr std::array kSetFields{RequestField{"path", Kind::kText, true, "the parameter"},
                                RequestField{"value", Kind::kValue, true, "in the text format of its type"}};

constexpr std::array kReloadFields{RequestField{"plugin", Kind::kText, true, "its name"}};
constexpr std::array kRestartFields{RequestField{
    "path", Kind::kText, false, "a module, or a group of which all that have failed; none: the whole application"}};

constexpr std::array kLogFields{
    RequestField{"path", Kind::kText, false, "a module or a group; none: all"},
    RequestField{"level", Kind::kText, true, "debug, info, warning, error, off; or inherit, as what is around it"}};

constexpr bool kMoves = true, kMovesNothing = false;

constexpr std::array kTable{
    DescribedRequest{
        "stop", {}, "look", kMovesNothing, "every port that drives has its safe value, until release", "stop"},
    DescribedRequest{"release", kReleaseFields, "drive", kMoves,
                     "ends the STOP of the robot; or the block and the value by hand of one port", "release stop"},
    DescribedRequest{"publish", kPublishFields, "drive", kMoves,
                     "sets by hand the value that readers of a port see, until release",
                     "publish gate/wanted '{forward: 0.2}' --deadline 300ms"},
    DescribedRequest{"block", kBlockFields, "drive", kMovesNothing,
                     "one port has its safe value, whatever anybody sends, until release", "block gate/wanted"},
    DescribedRequest{"pause", kPauseFields, "change", kMovesNothing, "leaves modules out of cycles", "pause planner",
                     "drive"},
    DescribedRequest{"resume", kPauseFields, "change", kMoves, "has paused modules run again", "resume planner",
                     "drive"},
    DescribedRequest{"set", kSetFields, "change", kMoves, "sets a parameter", "set planner/cruise_speed 0.3"},
    DescribedRequest{"undo", {}, "change", kMoves, "takes back what was changed last", "undo"},
    DescribedRequest{"redo", {}, "change", kMoves, "does again what was taken back last", "redo"},
    DescribedRequest{"reload", kReloadFields, "change", kMoves, "loads a plugin anew, and makes its modules anew",
                     "reload planning"},
    DescribedRequest{"restart", kRestartFields, "change", kMoves, "makes modules, or the whole application, anew",
                     "restart planner"},
    DescribedRequest{"quit", {}, "change", kMovesNothing, "ends the run", "quit"},
    DescribedRequest{"log", kLogFields, "change", kMovesNothing, "from which level on modules are logged",
                     "log --level planner=debug"},
    // Made by clients.
    DescribedRequest{"change", {}, "change", kMoves, "changes the structure, all of it or nothing", "change"},
    DescribedRequest{"save", {}, "change", kMovesNothing, "writes the structure into a file", "save robot.xml"},
    DescribedRequest{"call", {}, "drive", kMoves, "calls a service", "call mapping/save_map"},
    DescribedRequest{"step", {}, "change", kMoves, "lets some cycles run", "step 10"},
    DescribedRequest{"speed", {}, "change", kMoves, "how fast simulated time passes", "speed 2"}};

// One for each kind of CommandRequest: what lacks one does not compile. A change is looked at by what is changed.
std::string_view NameOf(const ChangeRequest&) { return "change"; }
std::string_view NameOf(const UndoRequest&) { return "undo"; }
std::string_view NameOf(const RedoRequest&) { return "redo"; }
std::string_view NameOf(const SaveRequest&) { return "save"; }
std::string_view NameOf(const ReloadRequest&) { return "reload"; }
std::string_view NameOf(const PauseRequest& request) { return request.is_paused ? "pause" : "resume"; }
std::string_view NameOf(const PublishRequest&) { return "publish"; }
std::string_view NameOf(const BlockRequest&) { return "block"; }
std::string_view NameOf(const ReleaseRequest&) { return "release"; }
std::string_view NameOf(const RobotStopRequest& request) { return request.is_pressed ? "stop" : "release"; }
std::string_view NameOf(const RestartRequest&) { return "restart"; }
std::string_view NameOf(const QuitRequest&) { return "quit"; }

Error WrongField(std::string_view request, const RequestField& field, const std::string& what) {
  return {.message = "'" + std::string(request) + "' " + what + " '" + std::string(field.name) + "'",
          .hint = std::string(field.name) + ": " + std::string(field.help)};
}

// The fields of one request, which are known to be good as far as their names go.
class Reading {
 public:
  Reading(const DescribedRequest& request, const RequestFields& fields) : request_(request), fields_(fields) {}

  Result<void> Check() {
    for (const auto& [name, value] : fields_) {
      if (std::ranges::find(request_.fields, name, &RequestField::name) != request_.fields.end()) continue;
      return Error{.message = "'" + std::string(request_.name) + "' has no field '" + name + "'",
                   .hint = NearestNameHint(name, NamesOf(request_.fields, &RequestField::name))};
    }
    for (const RequestField& field : request_.fields) {
      const auto found = fields_.find(field.name);
      if (found == fields_.end()) {
        if (field.is_required) return WrongField(request_.name, field, "needs the field");
        continue;
      }
      if (auto good = CheckOne(field, found->second); !good) return good;
    }
    return {};
  }
  [[nodiscard]] std::string Text(std::string_view name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) return {};
    const auto* const number = std::get_if<double>(&found->second);
    return number != nullptr ? fmt::format("{}", *number) : std::get<std::string>(found->second);
  }
  std::optional<double> rate;
  std::optional<Duration> deadline;

 private:
  Result<void> CheckOne(const RequestField& field, const std::variant<std::string, double>& value) {
    const auto* const text = std::get_if<std::string>(&value);
    if (text != nullptr && text->empty() && field.kind != Kind::kValue) {
      return WrongField(request_.name, field, "got an empty word for");
    }
    if (text == nullptr && field.kind == Kind::kText) return WrongField(request_.name, field, "got a number for");
    if (field.kind == Kind::kNumber) {
      rate = text != nullptr ? NumberIn<double>(*text) : std::get<double>(value);
      if (!rate) return WrongField(request_.name, field, "got no number for");
    } else if (field.kind == Kind::kDuration) {
      // No deadline is as long as that; a duration can hold it.
      if (text == nullptr) deadline = FromSeconds(std::clamp(std::get<double>(value), -1e6, 1e6));
      if (text != nullptr) {
        const auto parsed = ParseDuration(*text);
        if (!parsed) return parsed.error();
        deadline = *parsed;
      }
    }
    return {};
  }

  const DescribedRequest& request_;
  const RequestFields& fields_;
};

}  // namespace

std::span<const DescribedRequest> RequestTable() { return kTable; }

bool LetsMove(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &DescribedRequest::name);
  return found != kTable.end() && found->lets_move;
}

bool LetsMove(const CommandRequest& request) {
  const auto* const change = std::get_if<ChangeRequest>(&request);
  return change != nullptr ? LetsMove(change->placed.changes)
                           : LetsMove(std::visit([](const auto& each) { return NameOf(each); }, request));
}

// Also by what is taken away: a module that has kept another one from driving, or the connection by which it did so.
bool LetsMove(const ChangeSet& changes) {
  return std::ranges::any_of(changes, [](const Change& each) {
    const ChangeForm* const form = FormOf(each);
    return form == nullptr || form->lets_move;
  });
}

Result<const DescribedRequest*> FindRequest(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &DescribedRequest::name);
  if (found != kTable.end()) return &*found;
  return Error{.message = "there is no request '" + std::string(name) + "'",
               .hint = NearestNameHint(name, NamesOf(kTable, &DescribedRequest::name))};
}

Result<CommandRequest> MakeRequest(std::string_view name, const RequestFields& fields, const std::string& client) {
  const auto found = FindRequest(name);
  if (!found) return found.error();
  Reading reading(**found, fields);
  if (auto good = reading.Check(); !good) return good.error();
  std::string path = reading.Text("path");
  if (name == "stop") return CommandRequest(RobotStopRequest{true, client});
  if (name == "release" && path == kRobotStopName) return CommandRequest(RobotStopRequest{false, client});
  if (name == "release") return CommandRequest(ReleaseRequest{std::move(path)});
  if (name == "block") return CommandRequest(BlockRequest{std::move(path)});
  if (name == "pause" || name == "resume") {
    return CommandRequest(PauseRequest{std::move(path), name == "pause"});
  }
  if (name == "publish") {
    return CommandRequest(
        PublishRequest{std::move(path), reading.Text("value"), reading.rate, reading.deadline, reading.Text("lease")});
  }
  if (name == "undo") return CommandRequest(UndoRequest{});
  if (name == "redo") return CommandRequest(RedoRequest{});
  if (name == "reload") return CommandRequest(ReloadRequest{reading.Text("plugin")});
  if (name == "restart") return CommandRequest(RestartRequest{std::move(path)});
  if (name == "quit") return CommandRequest(QuitRequest{});
  if (name != "set" && name != "log") return Error{.message = "'" + std::string(name) + "' is made by its client"};
  ChangeRequest change;
  change.client = client;
  if (name == "set") {
    change.placed.changes.emplace_back(SetParameter{std::move(path), reading.Text("value")});
  } else {
    LogElement log{path.empty() ? "/" : std::move(path)};
    const std::string wanted = reading.Text("level");
    const auto level = LogLevelOf(wanted);
    if (!level && wanted != "inherit") return level.error();
    if (level) log.level = *level;
    change.placed.changes.emplace_back(std::move(log));
  }
  change.placed.positions.push_back({std::string(name), 1, 1});
  return CommandRequest(std::move(change));
}

}  // namespace runnel
