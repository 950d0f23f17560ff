// Changes of an application, by whoever embeds it and by its clients.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "plugins/application/internal/application_parts.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/application_saver.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/command_service/hand_settings.h"
#include "plugins/parameters/configuration_saver.h"
#include "plugins/parameters/file_path.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/reload.h"

namespace runnel {

namespace {

// Modules that were replaced end what they have under way when they go, and they go when their successors have proved
// themselves. Not while time stands still.
void AwaitProof(StructureEditor& editor, Pace& pace) {
  constexpr auto kLongest = std::chrono::seconds(3);
  const auto until = std::chrono::steady_clock::now() + kLongest;
  for (auto look = std::chrono::milliseconds(1); editor.on_probation() > 0; look = std::min(2 * look, std::chrono::milliseconds(50))) {
    if (pace.is_paused() || std::chrono::steady_clock::now() > until) return;
    std::this_thread::sleep_for(look);
    editor.Tend();
  }
}

Result<void> ResultOf(const ChangeOutcome& outcome) {
  if (outcome) return {};
  return outcome.diagnostics.errors().front();
}

// What would be lost if something else were written there; nothing if there is no such file.
std::optional<Error> WhatIsLost(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  std::string what = "is there already";
  const auto document = XmlDocument::Load(file);
  if (document && document->root().name() == "application") {
    const XmlAttribute* const name = document->root().Attribute("name");
    what = "is the file of the application '" + (name != nullptr ? name->value : "") + "'";
  }
  return Error{.message = what + ", and would be lost",
               .position = {file.string()},
               .hint = "choose another name, or say --overwrite"};
}

// The same, unless the application came from it.
std::optional<Error> FindOverwritten(const FrameworkElement& application, const std::filesystem::path& file) {
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  const bool is_own = source != nullptr && Whole(source->file) == Whole(file);
  return is_own || file.empty() ? std::nullopt : WhatIsLost(file);
}

// What SaveApplication() with the same arguments would write, and what it would replace; whether the text would load is
// not tried. Under the structure lock.
Result<ServiceHooks::SaveDifference> PreviewSave(FrameworkElement& application, const SaveTools& tools,
                                                 const std::filesystem::path& chosen = {}) {
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  if (chosen.empty() && source == nullptr) {
    return Error{.message = "the application was built by code, and has no file yet",
                 .path = application.path(),
                 .hint = "name one"};
  }
  const std::filesystem::path file = chosen.empty() ? source->file : chosen;
  auto text = internal::TextOfApplication(application, tools, file.parent_path());
  if (!text) return text.error();
  ServiceHooks::SaveDifference difference{file.string(), {}, std::move(text->text)};
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) {
    auto before = XmlDocument::ReadText(file);
    if (!before) return before.error();
    difference.before = std::move(*before);
  }
  return difference;
}

// "planning" of "planning/bug1"; "" if there is none.
std::string PluginOf(std::string_view type) {
  const std::size_t slash = type.find('/');
  return std::string(type.substr(0, slash == std::string_view::npos ? 0 : slash));
}

// What is set now and no file keeps, as a sentence; "" for nothing. `has_stop`: whoever comes next has that. Under the
// structure lock.
std::string WhatPasses(FrameworkElement& application, const Scheduler& scheduler, bool has_stop) {
  std::string all;
  const auto add = [&](const std::string& what) { all += (all.empty() ? "" : ", ") + what; };
  if (!has_stop && application.runtime().robot_stop().in_force()) add("the STOP of the robot");
  bool is_recorded = false;
  for (const std::string& path : scheduler.PausedPaths()) add("the pause of " + path);
  application.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr) return;
    if (port->is_blocked()) add("the block of " + port->path());
    is_recorded = is_recorded || internal::IsRecorded(*port);
    if (port->is_set_by_hand()) add("the value by hand of " + port->path());
  });
  if (is_recorded) add("recordings");
  return all.empty() ? "" : "not saved, as it ends with the run: " + all;
}

// The next process of its file has neither what passes nor what is not saved.
std::string WhatEnds(FrameworkElement& application, const Scheduler& scheduler, const SaveTools& tools, bool has_stop) {
  std::string lost = WhatPasses(application, scheduler, has_stop);
  if (!lost.empty()) lost = "\n" + lost;
  const auto preview = PreviewSave(application, tools);
  if (preview && preview->before != preview->after) lost += "\nnot saved: what has been changed in " + preview->file;
  return lost;
}

}  // namespace

// What cannot be loaded is told by who then misses the type.
void Application::Parts::LoadPluginOf(std::string_view type) {
  const std::lock_guard lock(runtime().structure_mutex());
  const std::string plugin = PluginOf(type);
  if (plugin.empty() || plugins().modules().Find(type) != nullptr) return;
  (void)plugins().Load(plugin);
}

void Application::Parts::LoadPluginOf(const Change& change) {
  if (const auto* const create = std::get_if<runnel::CreateModule>(&change))
    LoadPluginOf(create->type);
  if (const auto* const replace = std::get_if<ReplaceModule>(&change)) LoadPluginOf(replace->type);
}

Result<FrameworkElement*> Application::CreateModule(std::string_view type,
                                                    const std::string& name) {
  return CreateModule(type, element(), name);
}

Result<FrameworkElement*> Application::CreateModule(std::string_view type, FrameworkElement& parent,
                                                    const std::string& name) {
  parts_->LoadPluginOf(type);
  return parts_->plugins().modules().Create(type, parent, name);
}

Result<void> Application::AddThread(const std::string& name, const ThreadOptions& options) {
  try {
    CreateThread(parts_->runtime(), name, options);
    return {};
  } catch (const ElementError& error) {
    return error.error();
  }
}

Result<void> Application::Assign(std::string_view path, const std::string& thread) {
  return ResultOf(Apply({AssignToThread{std::string(path), thread}}));
}

Result<void> Application::Connect(std::string_view from, std::string_view to,
                                  const ConnectOptions& options) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const PathSearch structure(parts_->runtime());
  if (options.when_present) {
    return LateConnections::Of(parts_->runtime()).Add(std::string(from), std::string(to), options);
  }
  auto source = structure.FindPortPart(from, PathKind::kOutput);
  auto sink = structure.FindPort(to, PathKind::kInput);
  if (!source || !sink) {  // perhaps it is made only when parameters are set
    if (auto constructed = Runtime::Construct(element()); !constructed) return constructed;
    if (!source) source = structure.FindPortPart(from, PathKind::kOutput);
    if (!sink) sink = structure.FindPort(to, PathKind::kInput);
  }
  if (sink && IsDistantPath(from)) {
    const auto brought = BringDistantPort(from, **sink, options);
    if (!brought) return brought;
    source = structure.FindPortPart(from, PathKind::kOutput);
    if (!source) {
      const auto [whole, part] = SplitPortPath(from);
      ConnectOptions wanted = options;
      if (!part.empty()) wanted.part = part;
      return LateConnections::Of(parts_->runtime()).Add(whole, std::string(to), wanted);
    }
  }
  if (!source) return source.error();
  if (!sink) return sink.error();
  ConnectOptions wanted = options;
  if (!source->part.empty()) wanted.part = source->part;
  return Port::Connect(*source->port, **sink, wanted);
}

ChangeOutcome Application::Apply(const ChangeSet& changes) {
  std::string text;
  for (const Change& change : changes) text += (text.empty() ? "" : "; ") + ChangeText(change);
  ChangeOutcome outcome = parts_->history->Apply(changes);
  parts_->log->Add(ApplicationLog::Kind::kChange, outcome ? std::move(text) : "refused: " + text);
  return outcome;
}

ChangeOutcome Application::Apply(std::string_view text) {
  Diagnostics diagnostics;
  const PlacedChanges changes = ParseChanges(text, {}, diagnostics);
  if (diagnostics.ok()) return Apply(changes.changes);
  ChangeOutcome outcome;
  outcome.diagnostics = std::move(diagnostics);
  return outcome;
}

ChangeOutcome Application::Swap(const std::string& path, const std::string& type,
                                std::vector<Setting> settings) {
  parts_->LoadPluginOf(type);
  return Apply({ReplaceModule{.path = path, .type = type, .settings = std::move(settings)}});
}

ChangeOutcome Application::Undo() { return parts_->history->Undo(); }
ChangeOutcome Application::Redo() { return parts_->history->Redo(); }

Result<void> Application::PublishByHand(std::string_view port, std::string_view value) {
  const auto set = SetPortByHand(parts_->runtime(), std::string(port), std::string(value));
  return set ? Result<void>() : set.error();
}

Result<void> Application::Release(std::string_view port) {
  if (port.empty()) return Error{.message = "which port is to be released is missing"};
  const auto released = ReleasePort(parts_->runtime(), std::string(port));
  return released ? Result<void>() : released.error();
}

Result<void> Application::Set(std::string_view path, std::string_view value) {
  {
    const std::lock_guard lock(parts_->runtime().structure_mutex());
    const auto found = PathSearch(parts_->runtime()).Find(path, PathKind::kParameter);
    if (!found) return found.error();
    auto* const parameter = dynamic_cast<Configurable*>(*found);
    if (parameter == nullptr) return IsAnother(**found, "a parameter");
    // What is not ready yet nobody runs, and static parameters can still be set.
    if ((*found)->life_cycle() == LifeCycle::kConstructed) {
      auto set = parameter->SetFromText(value);
      if (set) return set;
      Error error = set.error();
      if (error.path.empty()) error.path = (*found)->path();
      return error;
    }
  }
  return ResultOf(Apply({SetParameter{std::string(path), std::string(value)}}));
}

Result<std::string> Application::Get(std::string_view path) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const auto found = PathSearch(parts_->runtime()).Find(path, PathKind::kParameter);
  if (!found) return found.error();
  const auto* const parameter = dynamic_cast<const Configurable*>(*found);
  if (parameter == nullptr) return IsAnother(**found, "a parameter");
  return parameter->ToText();
}

Result<void> Application::Save(const std::filesystem::path& file, bool overwrites) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const auto found = parts_->FindAgain();
  if (!found) return found.error();
  const SaveTools tools{parts_->plugins(), parts_->tags()};
  if (!overwrites) {
    if (auto lost = FindOverwritten(**found, file)) return *lost;
  }
  auto saved = SaveApplication(**found, tools, file);
  const std::string passing = saved ? WhatPasses(**found, *parts_->scheduler, false) : "";
  if (!passing.empty()) parts_->Add({ApplicationEvent::Kind::kNotice, passing});
  return saved;
}

Result<std::string> Application::SaveConfiguration(const std::filesystem::path& file) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const auto found = parts_->FindAgain();
  if (!found) return found.error();
  LoadedValues none;  // composed in code
  auto* const source = (*found)->FindAnnotation<ApplicationSource>();
  return runnel::SaveConfiguration(**found, source != nullptr ? source->values : none, file);
}

bool Application::is_deleted() {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  return !parts_->FindAgain();
}

Result<void> Application::LoadPlugin(std::string_view plugin) {
  const auto find = [&] {
    const std::lock_guard lock(parts_->runtime().structure_mutex());
    return parts_->plugins().FindFile(plugin);
  };
  if (const auto file = find()) PluginManager::OpenAhead(*file);
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  return parts_->plugins().Load(plugin);
}

ChangeOutcome Application::Reload(const std::string& plugin) {
  const std::lock_guard one_at_a_time(parts_->reloading);
  return ReloadPlugin(parts_->plugins(), *parts_->editor, parts_->runtime(), plugin);
}

CommandService& Application::service() {
  if (parts_->service) return *parts_->service;
  ServiceHooks hooks = parts_->hooks;
  hooks.load_plugin = [this](const std::string& plugin) { return LoadPlugin(plugin); };
  hooks.library_of = [this](const std::string& plugin) -> std::string {
    const auto file = plugins().FindFile(plugin);
    return file ? file->string() : "";
  };
  hooks.save = [this](const std::string& file) -> Result<std::string> {
    std::string done = "saved " + parts_->path() + (file.empty() ? "" : " to " + file);
    if (auto saved = Save(file, true); !saved) return saved.error();
    const std::lock_guard lock(parts_->runtime().structure_mutex());
    const auto found = parts_->FindAgain();
    const std::string passing = found ? WhatPasses(**found, *parts_->scheduler, false) : "";
    return passing.empty() ? done : done + "\n" + passing;
  };
  hooks.preview_save = [this](const std::string& file) {
    const std::lock_guard lock(parts_->runtime().structure_mutex());
    const auto found = parts_->FindAgain();
    return found ? PreviewSave(**found, {parts_->plugins(), parts_->tags()}, file) : found.error();
  };
  hooks.find_overwritten = [this](const SaveRequest& request) -> std::optional<Error> {
    const std::lock_guard lock(parts_->runtime().structure_mutex());
    const auto found = parts_->FindAgain();
    if (!found) return {};
    return request.is_configuration ? WhatIsLost(request.file) : FindOverwritten(**found, request.file);
  };
  hooks.save_configuration = [this](const std::string& file) { return SaveConfiguration(file); };
  hooks.set_paused = [this](const std::string& path, bool is_paused) {
    return is_paused ? Pause(path) : Resume(path);
  };
  if (!hooks.quit) {
    hooks.quit = [this]() -> Result<std::string> {
      RequestStop();
      return std::string("stops");
    };
  }
  for (auto* const ends : {&hooks.quit, &hooks.restart}) {
    if (!*ends) continue;
    *ends = [this, end = *ends]() -> Result<std::string> {
      const auto what_ends = [this]() -> std::string {
        // Whoever has the lock does not keep the run from its end.
        const std::unique_lock lock(parts_->runtime().structure_mutex(), std::try_to_lock);
        const auto found = lock ? parts_->FindAgain() : Error{};
        return found ? WhatEnds(**found, *parts_->scheduler, {parts_->plugins(), parts_->tags()}, options().keeps_stop) : "";
      };
      const std::string lost = what_ends();
      auto ended = end();
      return ended ? Result<std::string>(*ended + lost) : ended;
    };
  }
  hooks.reload = [this](const std::string& plugin) -> Result<std::string> {
    std::string done = "loaded " + plugin + " anew";
    const auto outcome = Reload(plugin);
    if (!outcome) return outcome.diagnostics.errors().front();
    AwaitProof(*parts_->editor, parts_->scheduler->pace());
    return done;
  };
  return parts_->service.emplace(ServedApplication{
      parts_->runtime(), parts_->plugins().modules(), *parts_->editor, *parts_->log,
      std::move(hooks), &*parts_->history, &parts_->scheduler->pace(), &*parts_->scheduler});
}

}  // namespace runnel
