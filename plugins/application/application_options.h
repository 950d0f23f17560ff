#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plugins/scheduling/scheduler.h"

namespace runnel {

class ApplicationExtension;

/// A value from outside for the parameters that name it (`command_line="goal_x"`).
struct ApplicationSetting {
  ApplicationSetting(std::string_view name, std::string_view value)
      : text(std::string(name) + "=" + std::string(value)) {}
  /// "goal_x=4", as on a command line; what has no '=' becomes an error of loading.
  explicit ApplicationSetting(std::string argument) : text(std::move(argument)) {}

  std::string text;
};

/// Values for the options of an extension, in their order: {{"inspect", "8765"}, {"inspect-read-only", ""}}.
struct ExtensionArguments {
  std::vector<std::pair<std::string, std::string>> values = {};

  [[nodiscard]] bool Has(std::string_view option) const { return !All(option).empty(); }
  /// The last one; "" if there is none.
  [[nodiscard]] std::string Find(std::string_view option) const {
    const std::vector<std::string> all = All(option);
    return all.empty() ? "" : all.back();
  }
  [[nodiscard]] std::vector<std::string> All(std::string_view option) const {
    std::vector<std::string> all;
    for (const auto& [name, value] : values) {
      if (name == option) all.push_back(value);
    }
    return all;
  }
};

/// An extension that is a plugin: {"recording", {{{"record", "run.mcap"}}}}.
struct ExtensionByName {
  std::string name;
  ExtensionArguments arguments = {};
};

/// What is said of an application from outside of its file.
struct ApplicationOptions {
  std::vector<ApplicationSetting> settings = {};
  /// Configuration files; of two that name a value, the later wins.
  std::vector<std::string> configurations = {};
  /// Where plugins are looked for first.
  std::vector<std::filesystem::path> plugin_folders = {};

  /// Instead of what the file says, or for an application without one.
  std::optional<SchedulerOptions::ClockKind> clock = {};
  /// Simulated time: so many times real time; 0: as fast as it can. Errors: on a real clock.
  std::optional<double> speed = {};
  /// Simulated time begins with a pause. Errors: on a real clock.
  bool is_paused = false;
  /// What the cures of these errors are to name.
  const char* speed_words = "the speed";
  const char* pause_words = "the pause";

  /// Which module runs is noted, so that a CrashReport can name it.
  bool notes_running_modules = false;
  /// How long each module takes is measured from the start, and logged at the end of a run.
  bool is_profiled = false;

  /// Other processes of the same user reach it: `runnel ls`, `runnel swap`. That they cannot is a warning.
  bool has_control = false;
  /// STOP is kept in the user's run-time folder until it is released, and is in force again when the application of this
  /// file is loaded by another process. That the folder cannot be trusted is an error.
  bool keeps_stop = false;
  /// Begins without a STOP that was kept.
  bool clears_stop = false;
  /// What the program itself adds, in the order in which they begin. Each is of one application.
  std::vector<std::shared_ptr<ApplicationExtension>> extensions = {};
  /// What plugins add, after those. What the words of the file need is loaded besides.
  std::vector<ExtensionByName> extensions_by_name = {};
};

}  // namespace runnel
