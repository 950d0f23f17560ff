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
constexpr std::size_t kMostWords = 2;  // of those that are parsed one by one

}  // namespace

ControlCommandLine::ControlCommandLine(CLI::App& program) {
  // `example`: what is written behind "runnel".
  const auto add_plain = [&](const char* group, const char* name, const char* example, const char* description) -> Entry& {
    Entry& entry = entries_.emplace_back();
    entry.command = program.add_subcommand(name, description)->group(group);
    entry.command->footer(std::string("For example: runnel ") + example);
    entry.arguments.command = name;
    return entry;
  };
  const auto add = [&](const char* group, const char* name, const char* example, const char* description) -> Entry& {
    Entry& entry = add_plain(group, name, example, description);
    entry.command
        ->add_option("--app", entry.arguments.application, "which one, by name or process, if several are running")
        ->type_name("NAME|PROCESS")
        ->check([](const std::string& text) { return text.empty() ? "an empty word names no application" : ""; });
    return entry;
  };
  const auto word = [](Entry& entry, const char* name, const char* description) {
    // The parser keeps the address.
    entry.arguments.words.reserve(kMostWords);
    return entry.command->add_option(name, entry.arguments.words.emplace_back(), description)->required();
  };
  // `key`: what the request calls it.
  const auto option = [](Entry& entry, const char* name, const char* key, const char* description) {
    return entry.command->add_option_function<std::string>(
        name, [&entry, key](const std::string& value) { entry.arguments.options[key] = value; },
        description);
  };
  const auto flag = [](Entry& entry, const char* name, const char* key, const char* description, const char* value = "yes") {
    entry.command->add_flag_callback(name, [&entry, key, value] { entry.arguments.options[key] = value; }, description);
  };
  const auto count = [&](Entry& entry, const char* description) {
    option(entry, "-n", "count", description)->type_name("N")->check(CLI::Range(1, 1'000'000'000));
  };

  add(kStop, "stop", "stop", "STOP: all that moves something has its safe value, in each running application, or in that of --app");
  Entry& release = add(kStop, "release", "release", "ends the STOP; with a port, its block or the value set by hand there");
  word(release, "port", "one that is blocked or set by hand")->required(false)->type_name(kPort);
  Entry& block = add(kStop, "block", "block /drive/twist", "stops one port: its readers have the safe value, until release");
  word(block, "port", "input or output")->type_name(kPort);

  add_plain(kLooking, "ps", "ps", "lists the running applications, and how they are");

  Entry& ls = add(kLooking, "ls", "ls /robot -l", "shows what a running application is made of");
  word(ls, "path", "only this and what is below it")->required(false)->type_name(kElement);
  flag(ls, "-l,--long", "long", "also connections, rates, threads and their cycles");

  Entry& echo = add(kLooking, "echo", "echo /robot/planner/twist -n 5", "shows the values of a port, until Ctrl-C");
  word(echo, "port", "input or output")->type_name(kPort);
  count(echo, "ends after so many values");
  flag(echo, "--full", "full", "all digits, and all of long lists and texts");

  Entry& get = add(kLooking, "get", "get /robot/planner/cruise_speed", "says the value of a parameter, or the newest at a port, once");
  word(get, "path", "parameter or port")->type_name(kElement);
  flag(get, "--full", "full", "with all digits");

  Entry& hz = add(kLooking, "hz", "hz /laser/scan", "shows each second how often a port publishes, until Ctrl-C");
  word(hz, "port", "input or output")->type_name(kPort);
  count(hz, "ends after so many seconds");

  Entry& set = add(kChanging, "set", "set /robot/planner/cruise_speed 0.3", "gives a parameter another value");
  word(set, "parameter", "its path")->type_name(kElement);
  word(set, "value", "in its text format")->type_name("VALUE");

  Entry& publish = add(kChanging, "publish", "publish /robot/goal '{x: 2, y: 1}'", "sets by hand the value that readers of a port see, until release");
  word(publish, "port", "input or output")->type_name(kPort);
  word(publish, "value", "in its text format")->type_name("VALUE");
  option(publish, "--rate", "rate", "publishes it again so often, in Hz of the application's time")->type_name("HZ");
  option(publish, "--deadline", "deadline",
         "if no new value comes within TIME, the safe value is used until release: 300ms")
      ->type_name("TIME");

  Entry& call = add(kChanging, "call", "call /mapper/save '{file: map.pgm}'", "calls a service of a module, and shows its reply");
  word(call, "service", "its path")->type_name("SERVICE");
  word(call, "arguments", "in their text format: {file: map.pgm}")->required(false)->type_name("VALUE");
  option(call, "--timeout", "timeout", "on the application's clock: 30s")->type_name("TIME");

  Entry& activities = add(kLooking, "activities", "activities", "shows services that take long, and how far they are");
  word(activities, "service", "one, to be aborted")->required(false)->type_name("SERVICE");
  flag(activities, "--all", "all", "also those that do not take long");
  flag(activities, "--abort", "abort", "asks what is under way there to end");

  add(kLooking, "network", "network", "shows who is in the network, what is offered and taken, and what does not fit");
  Entry& offer = add(kChanging, "offer", "offer /laser/scan --topic /scan", "lets others in the network read a port; --remove ends it");
  word(offer, "port", "output or interface port")->type_name(kPort);
  Entry& take = add(kChanging, "take", "take /cmd_vel /drive/twist", "feeds a topic of the network into an input; --remove ends it");
  word(take, "topic", "its name: /cmd_vel")->type_name("TOPIC");
  word(take, "port", "input")->type_name(kPort);
  for (const char* const each : {"topic", "as", "frame", "child_frame", "qos", "sending", "rate", "strength"}) {
    option(offer, (std::string("--") + each).c_str(), each, "as in <offer>");
  }
  for (const char* const each : {"as", "field", "qos", "stamp", "exclusive", "live"}) {
    option(take, (std::string("--") + each).c_str(), each, "as in <take>");
  }
  for (Entry* const each : {&offer, &take}) flag(*each, "--remove", "remove", "ends it", "true");

  Entry& connect = add(kChanging, "connect", "connect /laser/scan /robot/planner/scan --queue 10", "connects two ports");
  word(connect, "from", "output; PORT.x, PORT[0]: that part of its values")->type_name(kPort);
  word(connect, "to", "input")->type_name(kPort);
  option(connect, "--queue", "queue", "so many values may wait")->type_name("N");
  option(connect, "--on-full", "on_full", "what a full queue does: drop_oldest, drop_newest, refuse")->type_name("WORD");
  flag(connect, "--pull", "pull", "reading the input has the output make a value", "true");
  option(connect, "--convert", "convert",
         "by which conversion: round, truncate, parse, or what a plugin has registered")
      ->type_name("NAME");
  flag(connect, "--when-present", "when", "as soon as both are there, and again after one went", "present");
  flag(connect, "--late", "late", "in a loop of modules, values come one cycle late by this one", "true");

  Entry& disconnect = add(kChanging, "disconnect", "disconnect /laser/scan /robot/planner/scan", "takes the connection of two ports back");
  word(disconnect, "from", "output")->type_name(kPort);
  word(disconnect, "to", "input")->type_name(kPort);

  Entry& create = add(kChanging, "create", "create /robot/filter sensors/scan_filter window=5", "makes a module; 'create group PATH'; 'create port PATH input TYPE'; 'create "
                      "parameter PATH PARAMETER ...'; 'create thread NAME period=10ms'");
  create.command
      ->add_option("words", create.arguments.words, "path, module type and values of parameters")
      ->required()
      ->type_name("PATH TYPE NAME=VALUE");

  Entry& remove = add(kChanging, "delete", "delete /robot/filter", "deletes a module, a group or an interface port");
  word(remove, "path", "of what is to go")->type_name(kElement);
  flag(remove, "--yes", "yes", "also if it is the whole application, which ends its run");

  Entry& swap = add(kChanging, "swap", "swap /robot/planner planning/tangent_bug", "puts another module in the place of one, with its connections");
  swap.command->add_option("words", swap.arguments.words, "path, new type and values of parameters")
      ->required()
      ->type_name("PATH TYPE NAME=VALUE");
  option(swap, "--probation", "probation",
         "the old one comes back if the new one throws in so many first cycles (10)")
      ->type_name("CYCLES");

  Entry& rename = add(kChanging, "rename", "rename /robot/planner old_planner", "gives a module or group another name; connections and state stay");
  word(rename, "path", "module or group")->type_name(kElement);
  word(rename, "name", "the new one")->type_name("NAME");

  Entry& copy = add(kChanging, "copy", "copy /robot/planner second_planner", "makes another module or group like one, beside it, with its values");
  word(copy, "path", "module or group")->type_name(kElement);
  word(copy, "name", "of the copy; without, the first that is free")->required(false)->type_name("NAME");

  Entry& move = add(kChanging, "move", "move /robot/planner control", "has a module or group run by another thread");
  word(move, "path", "module or group")->type_name(kElement);
  word(move, "thread", "its name; \"\": that of the group again")->type_name("THREAD");

  Entry& tag = add(kChanging, "tag", "tag /robot/planner safety", "says something of an element to viewers: safety, hidden; without a word, nothing any more");
  tag.command->add_option("words", tag.arguments.words, "path, and its tags")->required()->type_name("PATH [WORD ...]");

  Entry& change = add(kChanging, "change", "change changes.txt", "carries out a file of changes, all or none");
  word(change, "file", "one change a line; -: standard input")->type_name("FILE|-");
  flag(change, "--yes", "yes", "also if they delete the whole application, which ends its run");

  add(kChanging, "undo", "undo", "takes back what was changed last");
  add(kChanging, "redo", "redo", "does again what was undone last");

  Entry& save = add(kChanging, "save", "save robot.xml", "saves the application as it is now");
  word(save, "file", "instead of the one that it came from")->required(false)->type_name("FILE");
  flag(save, "--config", "config", "values of parameters, back into the configuration that the application was loaded with");
  flag(save, "--overwrite", "overwrite", "also over the file of another application, which is kept as FILE~");

  Entry& reload = add(kChanging, "reload", "reload planning", "loads a plugin anew and makes its modules anew by it");
  word(reload, "plugin", "its name, as in <load>; build its library first")->type_name("PLUGIN");

  Entry& restart = add(kRun, "restart", "restart /robot/planner", "runs the application again from its file; with a path, makes a module anew, as after a fault");
  word(restart, "path", "module; group: those in it that have failed")->required(false)->type_name(kElement);
  add(kRun, "quit", "quit", "ends the run");

  Entry& record = add(kLooking, "record", "record /robot/pose -o run.mcap", "records what ports of a running application publish, until Ctrl-C");
  record.command
      ->add_option("patterns", record.arguments.words,
                   "the application, if several are running, and which ports: /robot/pose, */pose, "
                   "/robot/**; '!' in front: not those; without, all")
      ->type_name("[NAME|PROCESS] PATTERN");
  option(record, "-o,--output", "file", "the file (MCAP)")->required()->type_name("FILE.mcap");
  count(record, "ends after so many seconds");
  option(record, "--compression", "compression", "zstd, lz4 or none; without, the first that is there")->type_name("WORD");

  Entry& pause = add(kRun, "pause", "pause", "lets simulated time stand still; with a path, leaves modules or a thread out, on any clock");
  word(pause, "path", "module, group or thread")->required(false)->type_name(kElement);
  Entry& resume = add(kRun, "resume", "resume", "lets simulated time, or what is at the path, go on");
  word(resume, "path", "that was paused")->required(false)->type_name(kElement);

  Entry& step = add(kRun, "step", "step 5", "lets a paused application run one cycle, or some");
  word(step, "cycles", "how many; without, one")->required(false)->type_name("N");

  Entry& speed = add(kRun, "speed", "speed 4", "says how fast simulated time passes, or changes it");
  word(speed, "factor", "1 is real time, 0 as fast as it can")->required(false)->type_name("FACTOR");

  Entry& top = add(kLooking, "top", "top", "shows how long modules take, and the latency of chains of them, once a second");
  flag(top, "--once", "once", "one table, of one second");
  count(top, "ends after so many tables");

  Entry& profile = add(kLooking, "profile", "profile on", "says how long modules have taken; on, off: begins and ends measuring");
  word(profile, "on|off", "without: what has been measured")->required(false)->type_name("WORD");

  Entry& latency = add(kLooking, "latency", "latency /laser/scan /robot/planner/twist", "how old what a command goes back to is: measures between two ports");
  latency.command->add_option("ports", latency.arguments.words, "from a sensor's output to a command's; off: no more")->type_name("FROM TO [off]");

  Entry& schedule = add(kChanging, "schedule", "schedule control --period 10ms", "gives a thread another period, priority, or way in which its cycles begin");
  word(schedule, "thread", "its name")->type_name("THREAD");
  option(schedule, "--period", "period", "20ms, for example")->type_name("TIME");
  option(schedule, "--activation", "activation", "period, free_running, trigger (when data comes)")->type_name("WORD");
  option(schedule, "--priority", "priority", "0: ordinary; 1 .. 99: real-time")->type_name("N");
  option(schedule, "--on-overrun", "on_overrun", "skip, catch_up")->type_name("WORD");

  Entry& deadline = add(kRun, "deadline", "deadline /robot 50ms", "shows who does not return from its cycle, and says how long modules may take");
  word(deadline, "path", "module or group; without, only shows")->required(false)->type_name(kElement);
  word(deadline, "time", "200ms, for example; off: as long as they like")->required(false)->type_name("TIME");

  Entry& log = add(kLooking, "log", "log -f", "shows faults, warnings, changes and what modules say, since the start");
  flag(log, "-f,--follow", "follow", "goes on with what comes");
  option(log, "--level", "level",
         "instead: from now on, what modules at and below PATH say is logged from this level on: "
         "debug, info, "
         "warning, error, off, or again as around them: inherit; without PATH all of them")
      ->type_name("[PATH=]LEVEL");

  Entry& complete = add("", "complete", "complete ls /robot", "for the completion of shells");
  complete.command->prefix_command();
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

std::string WordsOfNow(const std::string& command, const std::vector<std::string>& left) {
  if (command == "stop" && !left.empty()) {
    return "'runnel stop' is the STOP of the robot, 'runnel pause PATH' leaves modules out of cycles, "
           "'runnel block PORT' stops one port";
  }
  if (std::ranges::find(left, "--stop") == left.end()) return "";
  return command == "publish" ? "'runnel block PORT'" : "'runnel " + command + " … --remove'";
}

std::vector<const char*> WithNegativeValues(int count, const char* const* words) {
  std::vector<const char*> all(words, words + count);
  const std::string_view last = all.back();
  const bool is_number =
      last.size() > 1 && last[0] == '-' && (last[1] == '.' || (last[1] >= '0' && last[1] <= '9'));
  const auto dashes = [](const char* word) { return std::string_view(word) == "--"; };
  const bool wants_value =
      count > 3 && (std::string_view(all[1]) == "set" || std::string_view(all[1]) == "publish" ||
                   std::string_view(all[1]) == "call");
  if (wants_value && std::string_view(all[static_cast<std::size_t>(count) - 2]) != "--rate" && is_number &&
      std::none_of(all.begin(), all.end(), dashes)) {
    all.insert(all.end() - 1, "--");
  }
  return all;
}

}  // namespace runnel::program
