#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/runnel/control_command.h"
#include "apps/runnel/exit_code.h"

namespace runnel::program {

/// Which application, and what is said of it from outside.
struct ApplicationArguments {
  std::string file;
  std::vector<std::string> configurations =
      {};                                  ///< files; of two that name a value, the later wins
  std::vector<std::string> settings = {};  ///< name=value
};

/// Whether browsers see it, and where.
struct InspectArguments {
  /// Stands for what the application file says, or else port 8765 of this machine; if another program
  /// has it, any that is free.
  static constexpr const char* kUsualPlace = "true";  // what CLI11 makes of an option without a value

  std::string place = {};  ///< "": only if the file says so; kUsualPlace; "[ADDRESS:]PORT"
  std::string token = {};
  std::vector<std::string> origins = {};  ///< of pages of other places that may connect
  bool is_read_only = false;
  bool is_refused = false;  ///< whatever the file says
  bool hold = false;        ///< goes on after the run, until Ctrl-C

  [[nodiscard]] bool is_wanted() const noexcept {
    return !place.empty() || !token.empty() || !origins.empty() || is_read_only || hold;
  }
};

/// What is recorded, if anything.
struct RecordArguments {
  std::string file = {};  ///< "": nothing
  std::vector<std::string> ports = {};
  std::string compression = {};  ///< "": the best there is
};

/// What is played into the application instead of what its modules publish.
struct ReplayArguments {
  std::string file = {};
  std::vector<std::string> ports = {};
  std::optional<double> rate = {};  ///< 1 if nothing is said, on a simulated clock
  std::optional<double> from = {};  ///< s after the recording's start
  std::optional<double> to = {};
  bool loops = false;
  bool steps = false;  ///< a cycle for each line of standard input
};

struct RunArguments {
  ApplicationArguments application;
  std::optional<double> speed = {};     ///< instead of the file's; 0: as fast as it can
  std::optional<double> duration = {};  ///< s, of the application's clock
  bool is_paused = false;               ///< begins with a pause
  bool quiet = false;
  bool statistics = false;
  std::string trace = {};   ///< a file for what the threads do; "": none
  bool has_control = true;  ///< other processes of the user can reach it
  InspectArguments inspect = {};
  RecordArguments record = {};
  /// Then `application` may have no file.
  std::optional<ReplayArguments> replay = {};
};

struct InfoArguments {
  std::string file = {};  ///< a recording
  bool is_json = false;
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
using CommandLine =
    std::variant<RunArguments, CheckArguments, ModulesArguments, SchemaArguments, GraphArguments,
                 ControlArguments, InfoArguments, VersionArguments, ExitCode>;

[[nodiscard]] CommandLine ParseCommandLine(int count, const char* const* words);

}  // namespace runnel::program
