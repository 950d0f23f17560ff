#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plugins/application/application_options.h"

namespace runnel::program {

/// What the program tells whoever called it.
enum class ExitCode : int {
  kDone = 0,
  kRunFailed = 1,  ///< the application ran, and did not come to a good end
  kBadInput = 2,   ///< application file, arguments, configuration, plugins
};

/// Which application, and what is said of it from outside.
struct ApplicationArguments {
  [[nodiscard]] ApplicationOptions Options() const;

  std::string file;
  std::vector<std::string> configurations = {};  ///< files; of two that name a value, the later wins
  std::vector<std::string> settings = {};        ///< name=value
};

struct CheckArguments {
  ApplicationArguments application;
  std::string model_file = {};  ///< into which what is checked is written as a model; "": into none
};

struct RunArguments {
  ApplicationArguments application;     ///< of a replay, it may have no file
  std::optional<double> speed = {};     ///< instead of the file's; 0: as fast as it can
  bool is_single_threaded = false;      ///< all cycles in one thread, whatever clock the file wants
  std::optional<double> duration = {};  ///< s, of the application's clock
  bool is_paused = false;               ///< begins with a pause
  bool quiet = false;
  bool statistics = false;
  bool is_profiled = false;
  std::string log_file = {};                   ///< "": none
  std::optional<std::string> crash_file = {};  ///< "": none; without, one that is named after the process
  bool has_control = true;                     ///< other processes of the user can reach it
  bool clears_stop = false;                    ///< begins without the STOP of a process before
  bool steps = false;                          ///< a cycle for each line of standard input
  std::vector<ExtensionByName> extensions = {};
  std::vector<std::string> preloads = {};  ///< libraries that these need from the start of the process
};

struct ModulesArguments {
  std::vector<std::string> plugins = {};  ///< none: all that can be found
  bool names_only = false;
  bool as_json = false;
};

struct SchemaArguments {
  std::vector<std::string> plugins = {};  ///< none: all that can be found
  std::string output = {};                ///< a file; "": standard output
};

struct GraphArguments {
  ApplicationArguments application;
  std::string output = {};  ///< a file; what it is called decides what it becomes
};

/// What is asked of a running application.
struct ControlArguments {
  std::string command = {};      ///< "ls", as on the command line
  std::string application = {};  ///< name or process; "": the only one
  std::vector<std::string> words = {};
  std::map<std::string, std::string> options = {};  ///< as requests have them: {"count", "3"}
};

/// What is to be done. If there is nothing (left) to do, for help has been printed or the arguments are wrong, it
/// does no more than give the exit code.
[[nodiscard]] std::function<ExitCode()> ParseCommandLine(int count, const char* const* words);

/// Builds the application and runs it until its monitors have come to a verdict, its time is up, a
/// fault stops it, or the user does. Progress and verdict go to stdout, all that is wrong to
/// stderr.
[[nodiscard]] ExitCode Run(const RunArguments& arguments);

/// Builds the application, runs nothing, and says what is wrong with it.
[[nodiscard]] ExitCode Check(const CheckArguments& arguments);

/// Draws the data flow of an application that is built and not run. SVG, PNG and PDF need the
/// program `dot` of Graphviz.
[[nodiscard]] ExitCode DrawGraph(const GraphArguments& arguments);

/// Lists the module types of plugins on stdout.
[[nodiscard]] ExitCode ListModules(const ModulesArguments& arguments);

/// Writes the XML schema of application files with the words and types of the plugins.
[[nodiscard]] ExitCode WriteSchema(const SchemaArguments& arguments);

/// Asks a running application and shows the answer: on stdout what was asked for, on stderr what is wrong.
[[nodiscard]] ExitCode Control(const ControlArguments& arguments);

/// The STOP of the robot, in each running application, or in the one that is named; says what has become of it in each.
[[nodiscard]] ExitCode Stop(const ControlArguments& arguments);

/// Writes what could stand in place of the last of the words, one a line: paths, types and threads of a
/// running application. For the completion of shells, so it says nothing where it knows nothing.
[[nodiscard]] ExitCode Complete(const ControlArguments& arguments);

}  // namespace runnel::program
