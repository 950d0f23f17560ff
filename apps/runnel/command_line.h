#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/runnel/control_command.h"
#include "apps/runnel/exit_code.h"
#include "plugins/application/application_options.h"

namespace runnel::program {

/// Which application, and what is said of it from outside.
struct ApplicationArguments {
  [[nodiscard]] ApplicationOptions Options() const;

  std::string file;
  std::vector<std::string> configurations =
      {};                                  ///< files; of two that name a value, the later wins
  std::vector<std::string> settings = {};  ///< name=value
};

struct RunArguments {
  ApplicationArguments application;     ///< of a replay, it may have no file
  std::optional<double> speed = {};     ///< instead of the file's; 0: as fast as it can
  std::optional<double> duration = {};  ///< s, of the application's clock
  bool is_paused = false;               ///< begins with a pause
  bool quiet = false;
  bool statistics = false;
  bool has_control = true;  ///< other processes of the user can reach it
  bool steps = false;       ///< a cycle for each line of standard input
  std::vector<ExtensionByName> extensions = {};
};

struct CheckArguments {
  ApplicationArguments application;
};

struct ModulesArguments {
  std::vector<std::string> plugins = {};  ///< none: all that can be found
  bool names_only = false;
};

struct SchemaArguments {
  std::vector<std::string> plugins = {};  ///< none: all that can be found
  std::string output = {};                ///< a file; "": standard output
};

struct GraphArguments {
  ApplicationArguments application;
  std::string output = {};  ///< a file; what it is called decides what it becomes
};

struct VersionArguments {};

/// What to do; or, if there is nothing (left) to do, the exit code: help has been printed, or what
/// is wrong with the arguments.
using CommandLine = std::variant<RunArguments, CheckArguments, ModulesArguments, SchemaArguments,
                                 GraphArguments, ControlArguments, VersionArguments, ExitCode>;

[[nodiscard]] CommandLine ParseCommandLine(int count, const char* const* words);

}  // namespace runnel::program
