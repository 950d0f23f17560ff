// From a file, a text or code to an application that is ready to run, in the steps of the README.

#include <filesystem>
#include <mutex>
#include <utility>

#include "core/element/attempt.h"
#include "core/element/file_notes.h"
#include "plugins/application/internal/application_parts.h"
#include "plugins/application_tags/run_description.h"

namespace runnel {

namespace {

using ClockKind = SchedulerOptions::ClockKind;

// A module that does not return from its cycle for so long is told as stuck, unless somebody says otherwise.
constexpr Duration kStuckAfter = std::chrono::seconds(1);

Error Refusal(const char* message, const char* option) {
  return {.message = message,
          .hint = std::string("leave out ") + option + ", or add <clock type=\"simulated\"/> to the application"};
}

Result<void> Choose(const ApplicationOptions& chosen, SchedulerOptions& options) {
  const bool is_real = options.clock == ClockKind::kReal;
  if (chosen.speed && is_real) {
    return Refusal("the speed of real time cannot be chosen", chosen.speed_words);
  }
  if (chosen.is_paused && is_real) return Refusal("real time cannot be paused", chosen.pause_words);
  if (chosen.speed) options.speed = *chosen.speed;
  if (chosen.is_paused) options.is_paused = true;
  return {};
}

}  // namespace

Error Application::Parts::Placed(Error error) const {
  return error.WithPath(path()).WithPosition(FindSourcePlace(*element_)).WithPosition(file());
}

Result<void> Application::Parts::Schedule() {
  SchedulerOptions made = SchedulerOptionsOf(*element_);
  if (options().clock) made.clock = *options().clock;
  made.notes_running_tasks = options().notes_running_modules;
  for (const auto& extension : extensions()) {
    ++prepared_extensions;
    if (auto prepared = extension->Prepare(*element_, made); !prepared) return prepared;
  }
  if (auto possible = Choose(options(), made); !possible) return possible;
  scheduler.emplace(runtime(), made);
  if (options().is_profiled) scheduler->SetProfiled(true);
  (void)scheduler->SetStuckLimit("", kStuckAfter);
  editor.emplace(runtime(), plugins().modules(), &*scheduler);
  history.emplace(*editor);
  supervisor.emplace(runtime(), *scheduler, [this](const ChangeSet& changes) -> Result<ChangeSet> {
    LoadPluginsOf(changes);
    ChangeSet back;
    if (auto applied = editor->Apply(changes, {}, {}, &back).ToResult(); !applied) return applied.error();
    return back;
  });
  return AddRules(*element_, *scheduler, *supervisor);
}

// What clients want to be recorded is, though nobody has said so at the start.
RecordingHook Application::Parts::RecordingOnDemand(Application& application) {
  return [this, &application](const RecordingRequest& wish) -> Result<std::unique_ptr<ClientRecording>> {
    ServiceHooks found;
    {
      const std::lock_guard no_save(reloading);
      const std::lock_guard lock(runtime().structure_mutex());  // as for all plugins
      const auto catalogue = ExtensionCatalogue::Read(plugins().search_path());
      if (!catalogue) return catalogue.error();
      const ExtensionDescription* const known = catalogue->FindCommand("record");
      if (known == nullptr) return Error{.message = "no extension that records is installed"};
      const auto made = MakeExtensions(*known, "'record'", {});
      if (!made) return made.error();
      for (const auto& extension : *made) extension->AddHooks(application, found);
    }
    if (!found.record) return Error{.message = "the extension that records does not do so"};
    return found.record(wish);
  };
}

Result<void> Application::Parts::Begin(Application& application, Diagnostics& diagnostics) {
  report.emplace(runtime());
  start = runtime().clock().Now();
  {
    const std::lock_guard lock(events_mutex);
    log.emplace(runtime().clock());
  }
  for (const LogMessage& message : std::exchange(early_messages, {})) Hear(message);
  for (const auto& extension : extensions()) extension->AddHooks(application, hooks);
  if (!hooks.record) hooks.record = RecordingOnDemand(application);
  if (options().keeps_stop && !file().empty()) {
    auto follows = StopFile::Follow(runtime().robot_stop(), *log, file(), name(), options().clears_stop, diagnostics);
    if (!follows) return follows.error();
    stop_file = std::move(*follows);
    if (stop_file) hooks.is_stop_kept = [file = stop_file.get()] { return file->IsKept(); };
  }
  if (options().has_control) {
    auto server = ControlServer::Start(application.service(), {.application = name(), .file = file()});
    if (server) {
      control = std::move(*server);
    } else {
      diagnostics.AddWarning(server.error().WithContext("other processes cannot reach this application"));
    }
  }
  for (const auto& extension : extensions()) {
    if (auto begun = extension->Begin(application, diagnostics); !begun) return begun;
  }
  const auto* const rules = element_->FindAnnotation<RunRules>();
  if (rules != nullptr && rules->operators_timeout) application.service().operators().Begin(*rules->operators_timeout);
  return {};
}

LoadedApplication Application::Load(const std::filesystem::path& file, ApplicationOptions options) {
  return Make([&](Parts& parts) { return parts.Read(file); }, std::move(options));
}

LoadedApplication Application::LoadText(std::string_view text, ApplicationOptions options,
                                        const std::filesystem::path& folder, const std::string& name) {
  return Make([&](Parts& parts) { return parts.ReadText(text, folder, name); }, std::move(options));
}

LoadedApplication Application::LoadFrom(const ApplicationDescription::Describe& describe, ApplicationOptions options) {
  return Make([&](Parts& parts) { return parts.ReadFrom(describe); }, std::move(options));
}

LoadedApplication Application::Compose(const std::string& name, ApplicationOptions options) {
  return Make(
      [&](Parts& parts) {
        parts.is_composed = true;
        return parts.MakeEmpty(name);
      },
      std::move(options));
}

LoadedApplication Application::Make(const std::function<bool(Parts&)>& describe, ApplicationOptions options) {
  LoadedApplication loaded;
  Diagnostics& diagnostics = loaded.diagnostics_;
  try {
    std::unique_ptr<Application> application(new Application(std::move(options)));
    Parts& parts = *application->parts_;
    const bool is_right = describe(parts);
    diagnostics = parts.diagnostics();
    if (!is_right) return loaded;
    auto prepared = Attempt([&] { return parts.Schedule(); }, "preparing the run failed: ");
    if (prepared && !parts.is_composed) prepared = MakeApplicationReady(*parts.element());
    if (!prepared) {
      diagnostics.Add(parts.Placed(prepared.error()));
      return loaded;
    }
    if (auto begun = parts.Begin(*application, diagnostics); !begun) {
      diagnostics.Add(begun.error());
      return loaded;
    }
    loaded.application_ = std::move(application);
  } catch (...) {
    diagnostics.Add(CaughtError("loading failed: "));
  }
  return loaded;
}

Application::Application(ApplicationOptions options) : parts_(std::make_unique<Parts>(std::move(options))) {}

Application::~Application() { Stop(); }

Application::Parts::~Parts() {
  Join();
  if (scheduler) scheduler->Stop();
  control.reset();
  const auto& attached = extensions();
  for (std::size_t i = prepared_extensions; i > 0; --i) attached[i - 1]->End();
  service.reset();
  report.reset();
  supervisor.reset();
  history.reset();
  editor.reset();
  scheduler.reset();
  for (std::size_t i = prepared_extensions; i > 0; --i) attached[i - 1]->Release();
}

}  // namespace runnel
