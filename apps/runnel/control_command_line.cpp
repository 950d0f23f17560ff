#include "apps/runnel/control_command_line.h"

#include <algorithm>
#include <string_view>

namespace runnel::program {

namespace {

constexpr const char* kStop = "Stopping the robot";
constexpr const char* kLooking = "Looking at a running application";
constexpr const char* kChanging = "Changing it";
constexpr const char* kRun = "Its run";
constexpr const char* kElement = "PATH";
constexpr const char* kPort = "PORT";

// A list takes all words.
enum Need { kNeeded, kOptional, kList, kOptionalList };
struct WordForm {
  const char* name;
  const char* description;
  const char* type;
  Need need = kNeeded;
};
struct OptionForm {
  std::string name;
  const char* key;  // what the request calls it
  const char* description;
  const char* type = nullptr;  // of its value; nullptr: a flag
  const char* said = "yes";    // by a flag, in the request
  bool is_required = false;
};
OptionForm InOffer(const char* key) { return {"--" + std::string(key), key, "as in <offer>", "TEXT"}; }
OptionForm InTake(const char* key) { return {"--" + std::string(key), key, "as in <take>", "TEXT"}; }
const OptionForm kRemove{"--remove", "remove", "ends it", nullptr, "true"};
struct CommandForm {
  const char* group;
  const char* name;
  const char* example;  // what is written behind "runnel"
  const char* description;
  std::vector<WordForm> words = {};
  std::vector<OptionForm> options = {};
};

// clang-format off
const std::vector<CommandForm> kCommands{
    {kStop, "stop", "stop",
     "STOP: all that moves something has its safe value, in each running application, or in that of --app"},
    {kStop, "release", "release", "ends the STOP; with a port, its block or the value set by hand there",
     {{"port", "one that is blocked or set by hand", kPort, kOptional}}},
    {kStop, "block", "block /drive/twist", "stops one port: its readers have the safe value, until release",
     {{"port", "input or output", kPort}}},
    {kLooking, "ps", "ps", "lists the running applications, and how they are"},
    {kLooking, "ls", "ls /robot -l", "shows what a running application is made of",
     {{"path", "only this and what is below it", kElement, kOptional}},
     {{"-l,--long", "long", "also connections, rates, threads and their cycles"}}},
    {kLooking, "echo", "echo /robot/planner/twist -n 5", "shows the values of a port, until Ctrl-C",
     {{"port", "input or output", kPort}},
     {{"-n", "count", "ends after so many values", "N"}, {"--full", "full", "all digits, and all of long lists and texts"}}},
    {kLooking, "get", "get /robot/planner/cruise_speed", "says the value of a parameter, or the newest at a port, once",
     {{"path", "parameter or port", kElement}}, {{"--full", "full", "with all digits"}}},
    {kLooking, "hz", "hz /laser/scan", "shows each second how often a port publishes, until Ctrl-C",
     {{"port", "input or output", kPort}}, {{"-n", "count", "ends after so many seconds", "N"}}},
    {kChanging, "set", "set /robot/planner/cruise_speed 0.3", "gives a parameter another value",
     {{"parameter", "its path", kElement}, {"value", "in its text format", "VALUE"}}},
    {kChanging, "publish", "publish /robot/goal '{x: 2, y: 1}'",
     "sets by hand the value that readers of a port see, until release",
     {{"port", "input or output", kPort}, {"value", "in its text format", "VALUE"}},
     {{"--rate", "rate", "publishes it again so often, in Hz of the application's time", "HZ"},
      {"--deadline", "deadline", "if no new value comes within TIME, the safe value is used until release: 300ms", "TIME"}}},
    {kChanging, "call", "call /mapper/save '{file: map.pgm}'", "calls a service of a module, and shows its reply",
     {{"service", "its path", "SERVICE"}, {"arguments", "in their text format: {file: map.pgm}", "VALUE", kOptional}},
     {{"--timeout", "timeout", "on the application's clock: 30s", "TIME"}}},
    {kLooking, "activities", "activities", "shows services that take long, and how far they are",
     {{"service", "one, to be aborted", "SERVICE", kOptional}}, {{"--all", "all", "also those that do not take long"},
      {"--abort", "abort", "asks what is under way there to end"}}},
    {kLooking, "network", "network", "shows who is in the network, what is offered and taken, and what does not fit"},
    {kChanging, "offer", "offer /laser/scan --topic /scan", "lets others in the network read a port; --remove ends it",
     {{"port", "output or interface port", kPort}},
     {InOffer("topic"), InOffer("as"), InOffer("frame"), InOffer("child_frame"), InOffer("qos"), InOffer("sending"),
      InOffer("rate"), InOffer("strength"), kRemove}},
    {kChanging, "take", "take /cmd_vel /drive/twist", "feeds a topic of the network into an input; --remove ends it",
     {{"topic", "its name: /cmd_vel", "TOPIC"}, {"port", "input", kPort}},
     {InTake("as"), InTake("field"), InTake("qos"), InTake("stamp"), InTake("exclusive"), InTake("live"), kRemove}},
    {kChanging, "connect", "connect /laser/scan /robot/planner/scan --queue 10", "connects two ports",
     {{"from", "output; PORT.x, PORT[0]: that part of its values", kPort}, {"to", "input", kPort}},
     {{"--queue", "queue", "so many values may wait", "N"},
      {"--on-full", "on_full", "what a full queue does: drop_oldest, drop_newest, refuse", "WORD"},
      {"--pull", "pull", "reading the input has the output make a value", nullptr, "true"},
      {"--convert", "convert", "by which conversion: round, truncate, parse, or what a plugin has registered", "NAME"},
      {"--when-present", "when", "as soon as both are there, and again after one went", nullptr, "present"},
      {"--late", "late", "in a loop of modules, values come one cycle late by this one", nullptr, "true"}}},
    {kChanging, "disconnect", "disconnect /laser/scan /robot/planner/scan", "takes the connection of two ports back",
     {{"from", "output", kPort}, {"to", "input", kPort}}},
    {kChanging, "create", "create /robot/filter sensors/scan_filter window=5",
     "makes a module; 'create group PATH'; 'create port PATH input TYPE'; 'create "
     "parameter PATH PARAMETER ...'; 'create thread NAME period=10ms'",
     {{"words", "path, module type and values of parameters", "PATH TYPE NAME=VALUE", kList}}},
    {kChanging, "delete", "delete /robot/filter", "deletes a module, a group or an interface port",
     {{"path", "of what is to go", kElement}},
     {{"--yes", "yes", "also if it is the whole application, which ends its run"}}},
    {kChanging, "swap", "swap /robot/planner planning/tangent_bug",
     "puts another module in the place of one, with its connections",
     {{"words", "path, new type and values of parameters", "PATH TYPE NAME=VALUE", kList}},
     {{"--probation", "probation", "the old one comes back if the new one throws in so many first cycles (10)", "CYCLES"}}},
    {kChanging, "rename", "rename /robot/planner old_planner",
     "gives a module or group another name; connections and state stay",
     {{"path", "module or group", kElement}, {"name", "the new one", "NAME"}}},
    {kChanging, "copy", "copy /robot/planner second_planner",
     "makes another module or group like one, beside it, with its values", {{"path", "module or group", kElement},
      {"name", "of the copy; without, the first that is free", "NAME", kOptional}}},
    {kChanging, "move", "move /robot/planner control", "has a module or group run by another thread",
     {{"path", "module or group", kElement}, {"thread", "its name; \"\": that of the group again", "THREAD"}}},
    {kChanging, "tag", "tag /robot/planner safety",
     "says something of an element to viewers: safety, hidden; without a word, nothing any more",
     {{"words", "path, and its tags", "PATH [WORD ...]", kList}}},
    {kChanging, "change", "change changes.txt", "carries out a file of changes, all or none",
     {{"file", "one change a line; -: standard input", "FILE|-"}},
     {{"--yes", "yes", "also if they delete the whole application, which ends its run"}}},
    {kChanging, "undo", "undo", "takes back what was changed last"},
    {kChanging, "redo", "redo", "does again what was undone last"},
    {kChanging, "save", "save robot.xml", "saves the application as it is now",
     {{"file", "instead of the one that it came from", "FILE", kOptional}},
     {{"--config", "config", "values of parameters, back into the configuration that the application was loaded with"},
      {"--overwrite", "overwrite", "also over the file of another application, which is kept as FILE~"}}},
    {kChanging, "reload", "reload planning", "loads a plugin anew and makes its modules anew by it",
     {{"plugin", "its name, as in <load>; build its library first", "PLUGIN"}}},
    {kRun, "restart", "restart /robot/planner",
     "runs the application again from its file; with a path, makes a module anew, as after a fault",
     {{"path", "module; group: those in it that have failed", kElement, kOptional}}},
    {kRun, "quit", "quit", "ends the run"},
    {kLooking, "record", "record /robot/pose -o run.mcap",
     "records what ports of a running application publish, until Ctrl-C", {{"patterns",
       "the application, if several are running, and which ports: /robot/pose, */pose, "
       "/robot/**; '!' in front: not those; without, all", "[NAME|PROCESS] PATTERN", kOptionalList}},
     {{"-o,--output", "file", "the file (MCAP)", "FILE.mcap", "", true}, {"-n", "count", "ends after so many seconds", "N"},
      {"--compression", "compression", "zstd, lz4 or none; without, the first that is there", "WORD"}}},
    {kRun, "pause", "pause",
     "lets simulated time stand still; with a path, leaves modules or a thread out, on any clock",
     {{"path", "module, group or thread", kElement, kOptional}}},
    {kRun, "resume", "resume", "lets simulated time, or what is at the path, go on",
     {{"path", "that was paused", kElement, kOptional}}},
    {kRun, "step", "step 5", "lets a paused application run one cycle, or some",
     {{"cycles", "how many; without, one", "N", kOptional}}},
    {kRun, "speed", "speed 4", "says how fast simulated time passes, or changes it",
     {{"factor", "1 is real time, 0 as fast as it can", "FACTOR", kOptional}}},
    {kLooking, "top", "top", "shows how long modules take, and the latency of chains of them, once a second", {},
     {{"--once", "once", "one table, of one second"}, {"-n", "count", "ends after so many tables", "N"}}},
    {kLooking, "profile", "profile on", "says how long modules have taken; on, off: begins and ends measuring",
     {{"on|off", "without: what has been measured", "WORD", kOptional}}},
    {kLooking, "latency", "latency /laser/scan /robot/planner/twist",
     "how old what a command goes back to is: measures between two ports",
     {{"ports", "from a sensor's output to a command's; off: no more", "FROM TO [off]", kOptionalList}}},
    {kChanging, "schedule", "schedule control --period 10ms",
     "gives a thread another period, priority, or way in which its cycles begin", {{"thread", "its name", "THREAD"}},
     {{"--period", "period", "20ms, for example", "TIME"},
      {"--activation", "activation", "period, free_running, trigger (when data comes)", "WORD"},
      {"--priority", "priority", "0: ordinary; 1 .. 99: real-time", "N"},
      {"--on-overrun", "on_overrun", "skip, catch_up", "WORD"}}},
    {kRun, "deadline", "deadline /robot 50ms",
     "shows who does not return from its cycle, and says how long modules may take",
     {{"path", "module or group; without, only shows", kElement, kOptional},
      {"time", "200ms, for example; off: as long as they like", "TIME", kOptional}}},
    {kLooking, "log", "log -f", "shows faults, warnings, changes and what modules say, since the start", {},
     {{"-f,--follow", "follow", "goes on with what comes"}, {"--level", "level",
       "instead: from now on, what modules at and below PATH say is logged from this level on: debug, info, "
       "warning, error, off, or again as around them: inherit; without PATH all of them", "[PATH=]LEVEL"}}},
    {"", "complete", "complete ls /robot", "for the completion of shells"}};
// clang-format on

void AddWord(CLI::App& command, const WordForm& form, std::string& word, std::vector<std::string>& all) {
  const bool is_list = form.need == kList || form.need == kOptionalList;
  CLI::Option* const added = is_list ? command.add_option(form.name, all, form.description)
                                     : command.add_option(form.name, word, form.description);
  added->required(form.need == kNeeded || form.need == kList)->type_name(form.type);
}

void AddOption(CLI::App& command, const OptionForm& form, std::map<std::string, std::string>& said) {
  if (form.type == nullptr) {
    command.add_flag_callback(
        form.name, [&] { said[form.key] = form.said; }, form.description);
    return;
  }
  const auto take = [&](const std::string& value) { said[form.key] = value; };
  CLI::Option* const added = command.add_option_function<std::string>(form.name, take, form.description);
  added->required(form.is_required)->type_name(form.type);
  if (form.key == std::string_view("count")) added->check(CLI::Range(1, 1'000'000'000));
}

}  // namespace

ControlCommandLine::ControlCommandLine(CLI::App& program) {
  for (const CommandForm& form : kCommands) {
    Entry& entry = entries_.emplace_back();
    CLI::App& command = *(entry.command = program.add_subcommand(form.name, form.description)->group(form.group));
    command.footer(std::string("For example: runnel ") + form.example);
    ControlArguments& arguments = entry.arguments;
    arguments.command = form.name;
    if (arguments.command != "ps") {  // which is of all
      command.add_option("--app", arguments.application, "which one, by name or process, if several are running")
          ->type_name("NAME|PROCESS")
          ->check([](const std::string& text) { return text.empty() ? "an empty word names no application" : ""; });
    }
    command.prefix_command(arguments.command == "complete");
    arguments.words.resize(form.words.size());  // whose addresses the parser keeps, too
    for (std::size_t i = 0; i < form.words.size(); ++i) {
      AddWord(command, form.words[i], arguments.words[i], arguments.words);
    }
    for (const OptionForm& each : form.options) AddOption(command, each, arguments.options);
  }
}

std::optional<ControlArguments> ControlCommandLine::Parsed() const {
  for (const Entry& entry : entries_) {
    if (!entry.command->parsed()) continue;
    ControlArguments arguments = entry.arguments;
    if (arguments.command == "complete") arguments.words = entry.command->remaining();
    // What was left out goes; what was given as "" stays, and is refused.
    const auto has_room = [](const CLI::Option* option) { return option->get_positional(); };
    std::size_t given = 0;
    for (const CLI::Option* each : entry.command->get_options(has_room)) given += each->count();
    if (arguments.command != "complete") arguments.words.resize(given);
    return arguments;
  }
  return {};
}

std::vector<const char*> WithNegativeValues(int count, const char* const* words) {
  std::vector<const char*> all(words, words + count);
  const std::string_view last = all.back();
  const bool is_number = last.size() > 1 && last[0] == '-' && (last[1] == '.' || (last[1] >= '0' && last[1] <= '9'));
  const auto dashes = [](const char* word) { return std::string_view(word) == "--"; };
  const bool wants_value = count > 3 && (std::string_view(all[1]) == "set" || std::string_view(all[1]) == "publish" ||
                                         std::string_view(all[1]) == "call");
  if (wants_value && std::string_view(all[static_cast<std::size_t>(count) - 2]) != "--rate" && is_number &&
      std::none_of(all.begin(), all.end(), dashes)) {
    all.insert(all.end() - 1, "--");
  }
  return all;
}

}  // namespace runnel::program
