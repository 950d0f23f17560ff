#include "tests/integration/application_run.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/port.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_tags/application_tags.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/parameters/configuration.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/supervision/notices.h"

namespace runnel::test {

namespace {

std::string TextOfFile(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("'" + from + "' is not in the file");
  return text.replace(at, from.size(), to);
}

RunMonitor* FindMonitor(FrameworkElement& application) {
  RunMonitor* found = nullptr;
  application.Visit([&](FrameworkElement& element) {
    if (auto* monitor = element.FindAnnotation<RunMonitor>()) found = monitor;
  });
  return found;
}

}  // namespace

void UseApplication(const ApplicationChoice& choice, const std::function<void(RunningApplication& run)>& use) {
  const std::filesystem::path folder = std::filesystem::path(RUNNEL_XML) / "apps";
  std::string text = TextOfFile(folder / choice.name);
  for (const auto& [from, to] : choice.replace) text = Replaced(std::move(text), from, to);
  auto document = XmlDocument::Parse(text, choice.name);
  if (!document) throw std::runtime_error(document.error().ToString());

  PluginManager plugins;
  plugins.AddSearchFolder(RUNNEL_TEST_PLUGINS);
  XmlTagRegistry tags = ApplicationTags();
  plugins.registry().Offer(tags);
  Configuration configuration;
  for (const std::string& argument : choice.arguments) {
    if (auto added = configuration.AddArgument(argument); !added) {
      throw std::runtime_error(added.error().ToString());
    }
  }
  Runtime runtime;
  std::optional<Scheduler> scheduler;
  std::optional<StructureEditor> editor;
  std::optional<Supervisor> supervisor;
  const auto perform = [&](const ChangeSet& changes) -> Result<ChangeSet> {
    const ChangeOutcome outcome = editor->Apply(changes);
    if (!outcome) return outcome.diagnostics.errors().front();
    return ChangeSet();
  };
  const auto schedule = [&](FrameworkElement& application) -> Result<void> {
    SchedulerOptions options = SchedulerOptionsOf(application);
    options.speed = 0;
    scheduler.emplace(runtime, options);
    editor.emplace(runtime, plugins.modules(), &*scheduler);
    supervisor.emplace(runtime, *scheduler, perform);
    return AddRules(application, *scheduler, *supervisor);
  };
  const BuildOutcome built =
      BuildApplication(*document, folder, {runtime, plugins, tags, configuration}, BuildMode::kConstruct);
  if (built.application == nullptr) throw std::runtime_error(built.diagnostics.ToString());
  auto ready = schedule(*built.application);
  if (ready) ready = MakeApplicationReady(*built.application);
  if (!ready) throw std::runtime_error(ready.error().ToString());
  ChangeHistory history(*editor);
  RunningApplication run{runtime, *built.application, *scheduler, history, *supervisor};
  use(run);
}

ApplicationRun RunApplication(const ApplicationChoice& choice) {
  ApplicationRun run;
  UseApplication(choice, [&](RunningApplication& running) {
    RunMonitor* const monitor = FindMonitor(running.application);
    const auto pose = running.application.Find("world/sensor_output/pose");
    if (!pose) throw std::runtime_error(pose.error().ToString());
    const Time start = running.runtime.clock().Now();
    const LogSink sink(running.runtime, [&](const LogMessage& message) {
      if (message.level >= LogLevel::kWarning) run.warnings.emplace_back(message.time - start, message.BodyText());
    });
    auto change = choice.changes.begin();
    const auto step = [&] {
      for (; change != choice.changes.end() && change->first <= run.duration; ++change) {
        const ChangeOutcome outcome = running.history.Apply(change->second);
        if (!outcome) throw std::runtime_error(outcome.diagnostics.ToString());
      }
      if (choice.each_step) choice.each_step(running, run.duration);
      if (choice.before_step) choice.before_step();
      const bool went_on = running.scheduler.Step();
      if (choice.after_step) choice.after_step();
      return went_on;
    };
    while (run.duration < choice.limit && !run.outcome && step()) {
      dynamic_cast<Port&>(**pose).VisitLatest(
          [&](const void* value, Time) { run.truth.push_back(*static_cast<const Pose2*>(value)); });
      if (monitor != nullptr) run.outcome = monitor->Outcome();
      run.duration = running.runtime.clock().Now() - start;
    }
    run.faults = running.scheduler.TakeFaults();
    run.notices = test::NoticesOf(running.supervisor);
    run.was_stopped = running.scheduler.stop_requested();
  });
  return run;
}

}  // namespace runnel::test
