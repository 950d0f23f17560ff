#include "plugins/control/command_forms.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace runnel {

namespace {

constexpr const char* kStop = "Stopping the robot";
constexpr const char* kLooking = "Looking at a running application";
constexpr const char* kChanging = "Changing it";
constexpr const char* kRun = "Its run";
constexpr std::size_t kMostPatterns = 1000;

CommandWord PathWord(std::string name, std::string help) { return {std::move(name), std::move(help), "PATH"}; }
CommandWord PortWord(std::string help) { return {"port", std::move(help), "PORT"}; }
CommandWord MayLack(CommandWord word) {
  word.is_needed = false;
  return word;
}
CommandOption Count(std::string help) { return {"-n", "count", std::move(help), "N"}; }

std::vector<CommandForm> StopCommands() {
  return {{kStop, "stop", "stop",
           "STOP: all that moves something has its safe value, in each running application, or in that of --app"},
          {kStop,
           "release",
           "release",
           "ends the STOP; with a port, its block or the value set by hand there",
           {MayLack(PortWord("one that is blocked or set by hand"))}},
          {kStop,
           "block",
           "block /drive/twist",
           "stops one port: its readers have the safe value, until release",
           {PortWord("input or output")}}};
}

std::vector<CommandForm> ValueCommands() {
  return {
      {kLooking,
       "ls",
       "ls /robot -l",
       "shows what a running application is made of",
       {MayLack(PathWord("path", "only this and what is below it"))},
       {{"-l,--long", "long", "also connections, rates, threads and their cycles"}}},
      {kLooking,
       "echo",
       "echo /robot/planner/twist -n 5",
       "shows the values of a port, until Ctrl-C",
       {PortWord("input or output")},
       {Count("ends after so many values"), {"--full", "full", "all digits, and all of long lists and texts"}}},
      {kLooking,
       "get",
       "get /robot/planner/cruise_speed",
       "says the value of a parameter, or the newest at a port, once",
       {PathWord("path", "parameter or port")},
       {{"--full", "full", "with all digits"}}},
      {kLooking,
       "hz",
       "hz /laser/scan",
       "shows each second how often a port publishes, until Ctrl-C",
       {PortWord("input or output")},
       {Count("ends after so many seconds")}},
      {kLooking,
       "activities",
       "activities",
       "shows services that take long, and how far they are",
       {MayLack({"service", "one, to be aborted", "SERVICE"})},
       {{"--all", "all", "also those that do not take long"},
        {"--abort", "abort", "asks what is under way there to end"}}},
      {kLooking, "network", "network", "shows who is in the network, what is offered and taken, and what does not fit"},
      {kLooking,
       "record",
       "record /robot/pose -o run.mcap",
       "records what ports of a running application publish, until Ctrl-C",
       {{"patterns",
         "the application, if several are running, and which ports: /robot/pose, */pose, "
         "/robot/**; '!' in front: not those; without, all",
         "[NAME|PROCESS] PATTERN", false, kMostPatterns}},
       {{"-o,--output", "file", "the file (MCAP)", "FILE.mcap", "", true},
        Count("ends after so many seconds"),
        {"--compression", "compression", "zstd, lz4 or none; without, the first that is there", "WORD"}}}};
}

// Asked for by programs alone, for completion.
std::vector<CommandForm> ListsForPrograms() { return {{"", "paths", "", ""}, {"", "types", "", ""}}; }

std::vector<CommandForm> MeasuringCommands() {
  return {{kLooking,
           "top",
           "top",
           "shows how long modules take, and the latency of chains of them, once a second",
           {},
           {{"--once", "once", "one table, of one second"}, Count("ends after so many tables")}},
          {kLooking,
           "profile",
           "profile on",
           "says how long modules have taken; on, off: begins and ends measuring",
           {MayLack({"on|off", "without: what has been measured", "WORD"})}},
          {kLooking,
           "latency",
           "latency /laser/scan /robot/planner/twist",
           "how old what a command goes back to is: measures between two ports",
           {{"ports", "from a sensor's output to a command's; off: no more", "FROM TO [off]", false, 3}}},
          {kLooking,
           "log",
           "log -f",
           "shows faults, warnings, changes and what modules say, since the start",
           {},
           {{"-f,--follow", "follow", "goes on with what comes"},
            {"--level", "level",
             "instead: from now on, what modules at and below PATH say is logged from this level on: debug, info, "
             "warning, error, off, or again as around them: inherit; without PATH all of them",
             "[PATH=]LEVEL"}}}};
}

std::vector<CommandForm> ChangingCommands() {
  return {
      {kChanging,
       "publish",
       "publish /robot/goal '{x: 2, y: 1}'",
       "sets by hand the value that readers of a port see, until release",
       {PortWord("input or output"), {"value", "in its text format", "VALUE"}},
       {{"--rate", "rate", "publishes it again so often, in Hz of the application's time", "HZ"},
        {"--deadline", "deadline", "if no new value comes within TIME, the safe value is used until release: 300ms",
         "TIME"}}},
      {kChanging,
       "call",
       "call /mapper/save '{file: map.pgm}'",
       "calls a service of a module, and shows its reply",
       {{"service", "its path", "SERVICE"}, MayLack({"arguments", "in their text format: {file: map.pgm}", "VALUE"})},
       {{"--timeout", "timeout", "on the application's clock: 30s", "TIME"}}},
      {kChanging,
       "change",
       "change changes.txt",
       "carries out a file of changes, all or none",
       {{"file", "one change a line; -: standard input", "FILE|-"}},
       {{"--yes", "yes", "also if they delete the whole application, which ends its run"}}},
      {kChanging, "undo", "undo", "takes back what was changed last"},
      {kChanging, "redo", "redo", "does again what was undone last"},
      {kChanging,
       "save",
       "save robot.xml",
       "saves the application as it is now",
       {MayLack({"file", "instead of the one that it came from", "FILE"})},
       {{"--config", "config",
         "values of parameters, back into the configuration that the application was loaded with"},
        {"--overwrite", "overwrite", "also over the file of another application, which is kept as FILE~"}}},
      {kChanging,
       "reload",
       "reload planning",
       "loads a plugin anew and makes its modules anew by it",
       {{"plugin", "its name, as in <load>; build its library first", "PLUGIN"}}}};
}

std::vector<CommandForm> RunCommands() {
  return {{kRun,
           "restart",
           "restart /robot/planner",
           "runs the application again from its file; with a path, makes a module anew, as after a fault",
           {MayLack(PathWord("path", "module; group: those in it that have failed"))}},
          {kRun, "quit", "quit", "ends the run"},
          {kRun,
           "pause",
           "pause",
           "lets simulated time stand still; with a path, leaves modules or a thread out, on any clock",
           {MayLack(PathWord("path", "module, group or thread"))}},
          {kRun,
           "resume",
           "resume",
           "lets simulated time, or what is at the path, go on",
           {MayLack(PathWord("path", "that was paused"))}},
          {kRun,
           "step",
           "step 5",
           "lets a paused application run one cycle, or some",
           {MayLack({"cycles", "how many; without, one", "N"})}},
          {kRun,
           "speed",
           "speed 4",
           "says how fast simulated time passes, or changes it",
           {MayLack({"factor", "1 is real time, 0 as fast as it can", "FACTOR"})}},
          {kRun,
           "deadline",
           "deadline /robot 50ms",
           "shows who does not return from its cycle, and says how long modules may take",
           {MayLack(PathWord("path", "module or group; without, only shows")),
            MayLack({"time", "200ms, for example; off: as long as they like", "TIME"})}}};
}

}  // namespace

std::size_t CommandForm::least_words() const {
  return static_cast<std::size_t>(std::ranges::count(words, true, &CommandWord::is_needed));
}
std::size_t CommandForm::most_words() const {
  return std::accumulate(words.begin(), words.end(), std::size_t{0},
                         [](std::size_t sum, const CommandWord& each) { return sum + each.most; });
}

const std::vector<CommandForm>& CommandForms() {
  static const std::vector<CommandForm> all = [] {
    std::vector<CommandForm> forms;
    for (const auto& each : {StopCommands(), ValueCommands(), MeasuringCommands(), ChangingCommands(), RunCommands(),
                             ListsForPrograms()}) {
      forms.insert(forms.end(), each.begin(), each.end());
    }
    return forms;
  }();
  return all;
}

}  // namespace runnel
