#include "plugins/command_service/request_table.h"

#include <algorithm>
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
using Place = RequestField::Place;
using For = RequestField::For;

constexpr const char* kStop = "Stopping the robot";
constexpr const char* kLooking = "Looking at a running application";
constexpr const char* kChanging = "Changing it";
constexpr const char* kRun = "Its run";
constexpr bool kMoves = true, kMovesNothing = false;
constexpr std::size_t kMostPatterns = 1000;

// clang-format off
RequestField Word(const char* name, const char* shown, const char* help, Kind kind = Kind::kText) {
  return {.name = name, .shown = shown, .help = help, .kind = kind, .is_required = true};
}
RequestField MayLack(const char* name, const char* shown, const char* help, bool is_required = false) {
  return {.name = name, .shown = shown, .help = help, .place = Place::kOptionalWord, .is_required = is_required};
}
RequestField List(const char* name, const char* shown, const char* help, std::size_t most) {
  return {.name = name, .shown = shown, .help = help, .place = Place::kOptionalWord, .kind = Kind::kTexts, .most = most};
}
RequestField Option(const char* name, const char* shown, const char* help, Kind kind = Kind::kText, const char* flags = "") {
  return {.name = name, .shown = shown, .help = help, .place = Place::kOption, .kind = kind, .flags = flags};
}
RequestField Flag(const char* name, const char* help, const char* flags = "") {
  return {.name = name, .help = help, .place = Place::kOption, .kind = Kind::kFlag, .words = {"", "yes"}, .flags = flags};
}
RequestField Count(const char* help) { return Option("count", "N", help, Kind::kText, "-n"); }
RequestField Only(For whom, RequestField field, bool is_required = false) {
  field.whom = whom;
  field.is_required = is_required;
  return field;
}

// Of all clients: a method in Python, an operation of the page's, a service of Foxglove, a command of the terminal.
std::vector<DescribedRequest> SharedRequests() {
  return {
    DescribedRequest{"stop", kStop, "look", kMovesNothing,
      "STOP: all that moves something has its safe value, in each running application, or in that of --app", "stop"},
    DescribedRequest{"release", kStop, "drive", kMoves,
      "ends the STOP; with a port, its block or the value set by hand there", "release",
      {MayLack("path", "PORT", "one that is blocked or set by hand", true)}},
    DescribedRequest{"block", kStop, "drive", kMovesNothing,
      "stops one port: its readers have the safe value, until release", "block /drive/twist",
      {Word("path", "PORT", "input or output")}},
    DescribedRequest{"publish", kChanging, "drive", kMoves,
      "sets by hand the value that readers of a port see, until release", "publish /robot/goal '{x: 2, y: 1}'",
      {Word("path", "PORT", "input or output"), Word("value", "VALUE", "in its text format", Kind::kValue),
       Option("rate", "HZ", "publishes it again so often, in Hz of the application's time", Kind::kNumber),
       Option("deadline", "TIME", "if no new value comes within TIME, the safe value is used until release: 300ms",
              Kind::kDuration),
       Only(For::kOthers, Option("lease", "NAME", "of one hold of a key or stick: a value of a hold that has ended is refused"))}},
    DescribedRequest{"pause", kRun, "change", kMovesNothing,
      "lets simulated time stand still; with a path, leaves modules or a thread out, on any clock", "pause",
      {MayLack("path", "PATH", "module, group or thread", true)}, "drive"},
    DescribedRequest{"resume", kRun, "change", kMoves,
      "lets simulated time, or what is at the path, go on", "resume",
      {MayLack("path", "PATH", "that was paused", true)}, "drive"},
    // A change on the terminal.
    DescribedRequest{"set", "", "change", kMoves, "sets a parameter", "set /robot/planner/cruise_speed 0.3",
      {Word("path", "PATH", "the parameter"), Word("value", "VALUE", "in the text format of its type", Kind::kValue)}},
    DescribedRequest{"undo", kChanging, "change", kMoves, "takes back what was changed last", "undo"},
    DescribedRequest{"redo", kChanging, "change", kMoves, "does again what was undone last", "redo"},
    DescribedRequest{"reload", kChanging, "change", kMoves,
      "loads a plugin anew and makes its modules anew by it", "reload planning",
      {Word("plugin", "PLUGIN", "its name, as in <load>; build its library first")}},
    DescribedRequest{"restart", kRun, "change", kMoves,
      "runs the application again from its file; with a path, makes a module anew, as after a fault",
      "restart /robot/planner", {MayLack("path", "PATH", "module; group: those in it that have failed")}},
    DescribedRequest{"quit", kRun, "change", kMovesNothing, "ends the run", "quit"},
    DescribedRequest{"log", kLooking, "change", kMovesNothing,
      "shows faults, warnings, changes and what modules say, since the start", "log -f",
      {Only(For::kTerminal, Flag("follow", "goes on with what comes", "-f,--follow")),
       Only(For::kAll, Option("level", "[PATH=]LEVEL",
         "instead: from now on, what modules at and below PATH say is logged from this level on: debug, info, warning, error, "
         "off, or again as around them: inherit; without PATH all of them"), true),
       Only(For::kOthers, MayLack("path", "PATH", "a module or a group; none: all"))}},
    // Each client says these in its own way.
    DescribedRequest{"change", kChanging, "change", kMoves, "carries out a file of changes, all or none", "change changes.txt",
      {Only(For::kTerminal, Word("file", "FILE|-", "one change a line; -: standard input")),
       Only(For::kTerminal, Flag("yes", "also if they delete the whole application, which ends its run"))}},
    DescribedRequest{"save", kChanging, "change", kMovesNothing, "saves the application as it is now", "save robot.xml",
      {Only(For::kTerminal, MayLack("file", "FILE", "instead of the one that it came from")),
       Only(For::kTerminal, Flag("config",
         "values of parameters, back into the configuration that the application was loaded with")),
       Only(For::kTerminal, Flag("overwrite", "also over the file of another application, which is kept as FILE~"))}},
    DescribedRequest{"call", kChanging, "drive", kMoves,
      "calls a service of a module, and shows its reply", "call /mapper/save '{file: map.pgm}'",
      {Only(For::kTerminal, Word("service", "SERVICE", "its path")),
       Only(For::kTerminal, MayLack("arguments", "VALUE", "in their text format: {file: map.pgm}")),
       Only(For::kTerminal, Option("timeout", "TIME", "on the application's clock: 30s"))}},
    DescribedRequest{"step", kRun, "change", kMoves, "lets a paused application run one cycle, or some", "step 5",
      {Only(For::kTerminal, MayLack("cycles", "N", "how many; without, one"))}},
    DescribedRequest{"speed", kRun, "change", kMoves, "says how fast simulated time passes, or changes it", "speed 4",
      {Only(For::kTerminal, MayLack("factor", "FACTOR", "1 is real time, 0 as fast as it can"))}}};
}

std::vector<CommandForm> CommandsOfTerminals() {
  return {
    CommandForm{"ls", kLooking, "", kMovesNothing, "shows what a running application is made of", "ls /robot -l",
      {MayLack("path", "PATH", "only this and what is below it"),
       Flag("long", "also connections, rates, threads and their cycles", "-l,--long")}},
    CommandForm{"echo", kLooking, "", kMovesNothing, "shows the values of a port, until Ctrl-C", "echo /robot/planner/twist -n 5",
      {Word("port", "PORT", "input or output"), Count("ends after so many values"),
       Flag("full", "all digits, and all of long lists and texts")}},
    CommandForm{"get", kLooking, "", kMovesNothing,
      "says the value of a parameter, or the newest at a port, once", "get /robot/planner/cruise_speed",
      {Word("path", "PATH", "parameter or port"), Flag("full", "with all digits")}},
    CommandForm{"hz", kLooking, "", kMovesNothing,
      "shows each second how often a port publishes, until Ctrl-C", "hz /laser/scan",
      {Word("port", "PORT", "input or output"), Count("ends after so many seconds")}},
    CommandForm{"activities", kLooking, "", kMovesNothing, "shows services that take long, and how far they are", "activities",
      {MayLack("service", "SERVICE", "one, to be aborted"), Flag("all", "also those that do not take long"),
       Flag("abort", "asks what is under way there to end")}},
    CommandForm{"network", kLooking, "", kMovesNothing,
      "shows who is in the network, what is offered and taken, and what does not fit", "network"},
    CommandForm{"record", kLooking, "", kMovesNothing,
      "records what ports of a running application publish, until Ctrl-C", "record /robot/pose -o run.mcap",
      {List("patterns", "[NAME|PROCESS] PATTERN",
         "the application, if several are running, and which ports: /robot/pose, */pose, /robot/**; '!' in front: not those; "
         "without, all", kMostPatterns),
       Option("file", "FILE.mcap", "the file (MCAP)", Kind::kText, "-o,--output"), Count("ends after so many seconds"),
       Option("compression", "WORD", "zstd, lz4 or none; without, the first that is there")}},
    CommandForm{"top", kLooking, "", kMovesNothing,
      "shows how long modules take, and the latency of chains of them, once a second", "top",
      {Flag("once", "one table, of one second"), Count("ends after so many tables")}},
    CommandForm{"profile", kLooking, "", kMovesNothing,
      "says how long modules have taken; on, off: begins and ends measuring", "profile on",
      {MayLack("on|off", "WORD", "without: what has been measured")}},
    CommandForm{"latency", kLooking, "", kMovesNothing,
      "how old what a command goes back to is: measures between two ports", "latency /laser/scan /robot/planner/twist",
      {List("ports", "FROM TO [off]", "from a sensor's output to a command's; off: no more", 3)}},
    CommandForm{"deadline", kRun, "", kMovesNothing,
      "shows who does not return from its cycle, and says how long modules may take", "deadline /robot 50ms",
      {MayLack("path", "PATH", "module or group; without, only shows"),
       MayLack("time", "TIME", "200ms, for example; off: as long as they like")}},
    // For programs: what completion proposes.
    CommandForm{"paths", "", ""}, CommandForm{"types", "", ""}};
}
// clang-format on

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

const std::vector<CommandForm>& CommandForms() {
  static const std::vector<CommandForm> all = [] {
    std::vector<CommandForm> forms = SharedRequests();
    const std::vector<CommandForm> others = CommandsOfTerminals();
    forms.insert(forms.begin() + 3, others.begin(), others.end());                     // after what stops the robot
    std::erase_if(forms, [](const CommandForm& each) { return each.name == "set"; });  // is a change there
    for (CommandForm& each : forms) {
      std::erase_if(each.fields, [](const RequestField& field) { return field.whom == For::kOthers; });
    }
    return forms;
  }();
  return all;
}

const std::vector<DescribedRequest>& RequestTable() {
  static const std::vector<DescribedRequest> all = [] {
    std::vector<DescribedRequest> requests = SharedRequests();
    for (DescribedRequest& each : requests) {
      std::erase_if(each.fields, [](const RequestField& field) { return field.whom == For::kTerminal; });
    }
    return requests;
  }();
  return all;
}

bool LetsMove(std::string_view name) {
  const auto found = std::ranges::find(RequestTable(), name, &DescribedRequest::name);
  return found != RequestTable().end() && found->lets_move;
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
  const auto found = std::ranges::find(RequestTable(), name, &DescribedRequest::name);
  if (found != RequestTable().end()) return &*found;
  return Error{.message = "there is no request '" + std::string(name) + "'",
               .hint = NearestNameHint(name, NamesOf(RequestTable(), &DescribedRequest::name))};
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
