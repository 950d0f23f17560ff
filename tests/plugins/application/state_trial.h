#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include "core/element/robot_stop.h"
#include "core/paths/path_search.h"
#include "plugins/application/application.h"
#include "plugins/command_service/command_service.h"
#include "plugins/recording/recorder.h"
#include "plugins/recording/recording_player.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {

inline constexpr const char* kTrialText = R"(<application name="app">
  <load plugin="states"/>
  <clock type="simulated" speed="0"/>
  <network name="trial" engine="fake"/>
  <thread name="fast" period="10ms"/>
  <thread name="slow" period="20ms"/>
  <group name="g">
    <module name="m" type="states/filter"/>
  </group>
  <module name="source" type="states/source"/>
  <module name="sink" type="states/filter"/>
  <connect from="g/m/out" to="sink/in"/>
  <driving port="g/m/in"/>
</application>
)";

/// An application, and where in it is what has been set.
struct Trial {
  explicit Trial(const std::filesystem::path& from) : file(from), application(Load(from)) {
    (void)application->runtime().robot_stop().Release("the trial");  // that of a trial before outlives it
  }

  static LoadedApplication Load(const std::filesystem::path& file) {
    auto loaded = Application::Load(
        file, {.plugin_folders = {RUNNEL_TEST_STATES_PLUGIN, RUNNEL_TEST_PLUGIN_FOLDER}, .keeps_stop = true});
    if (!loaded) throw std::runtime_error(loaded.diagnostics().ToString());
    return loaded;
  }

  template <typename T = FrameworkElement>
  [[nodiscard]] T& At(const std::string& path) {
    const std::lock_guard lock(application->runtime().structure_mutex());
    const auto found = application->runtime().root().Find(path);
    if (!found) throw std::runtime_error(found.error().ToString());
    return dynamic_cast<T&>(**found);
  }
  [[nodiscard]] FrameworkElement& Module() { return At(module); }
  // Of a module, or of a composite.
  [[nodiscard]] Port& In(const std::string& name = "in") { return Find(name, PathKind::kInput); }
  [[nodiscard]] Port& Out() { return Find("out", PathKind::kOutput); }
  [[nodiscard]] Port& Find(const std::string& name, PathKind kind) {
    const std::lock_guard lock(application->runtime().structure_mutex());
    const auto found = PathSearch(application->runtime()).FindPort(module + "/" + name, kind);
    if (!found) throw std::runtime_error(found.error().ToString());
    return **found;
  }

  void Note(const ChangeOutcome& outcome) {
    is_refused = is_refused || !outcome;
    told += outcome.diagnostics.ToString();
  }
  void Do(const ChangeSet& changes) { Note(application->Apply(changes)); }
  void Undo() { Note(application->Undo()); }
  // A step on the way to what is tried.
  void Must(const ChangeSet& changes) {
    const auto outcome = application->Apply(changes);
    if (!outcome) throw std::runtime_error(outcome.diagnostics.ToString());
  }

  const std::filesystem::path file;
  LoadedApplication application;
  std::unique_ptr<Recorder> recorder = {};
  std::unique_ptr<Player> player = {};  // goes before what it plays to
  std::string module = "/app/g/m";
  std::string told = {};
  bool is_refused = false;
  TemporaryFolder folder{};
};

inline void Require(const Result<void>& result) {
  if (!result) throw std::runtime_error(result.error().ToString());
}

}  // namespace runnel::test
