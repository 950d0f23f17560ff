// Changes of an application, by whoever embeds it and by its clients.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "core/element/attempt.h"
#include "core/element/runtime.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/paths/new_feeds.h"
#include "core/paths/path_search.h"
#include "plugins/application/internal/application_parts.h"
#include "plugins/application/what_is_lost.h"
#include "plugins/application_files/saving/application_saver.h"
#include "plugins/command_service/hand_settings.h"
#include "plugins/command_service/request_table.h"
#include "plugins/parameters/configuration_saver.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/reload.h"

namespace runnel {

namespace {

// Modules that were replaced end what they have under way when they go, and they go when their successors have proved
// themselves. Not while time stands still.
void AwaitProof(StructureEditor& editor, Pace& pace) {
  constexpr auto kLongest = std::chrono::seconds(3);
  const auto until = std::chrono::steady_clock::now() + kLongest;
  while (editor.on_probation() > 0 && !pace.is_paused() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    editor.Tend();
  }
}

// Where another file is written, that one does not begin under it.
bool KeepsStop(StopFile* file, bool is_own_file = true) { return is_own_file && file != nullptr && file->IsKept(); }

// "planning" of "planning/bug1"; "" if there is none.
std::string PluginOf(std::string_view type) {
  const std::size_t slash = type.find('/');
  return std::string(type.substr(0, slash == std::string_view::npos ? 0 : slash));
}

}  // namespace

// What cannot be loaded is told by who then misses the type.
void Application::Parts::LoadPluginOf(std::string_view type) {
  const std::string plugin = PluginOf(type);
  {
    const std::lock_guard lock(runtime().structure_mutex());
    if (plugin.empty()) return;
    // Types that are found late are the process's: another application may have loaded their plugin, this one not yet.
    const ModuleType* const found = plugins().modules().Find(type);
    if (found != nullptr && (found->plugin != plugin || plugins().IsLoaded(plugin))) return;
  }
  (void)LoadPlugin(plugin);
}

// Not while a save walks the plugins that are there.
Result<void> Application::Parts::LoadPlugin(std::string_view plugin) {
  const std::lock_guard one_at_a_time(reloading);
  const auto find = [&] {
    const std::lock_guard lock(runtime().structure_mutex());
    return plugins().FindFile(plugin);
  };
  if (const auto file = find()) PluginManager::OpenAhead(*file);
  const std::lock_guard lock(runtime().structure_mutex());
  return plugins().Load(plugin);
}

void Application::Parts::LoadPluginsOf(const ChangeSet& changes) {
  for (const Change& change : changes) {
    if (const auto* const create = std::get_if<runnel::CreateModule>(&change)) LoadPluginOf(create->type);
    if (const auto* const replace = std::get_if<ReplaceModule>(&change)) LoadPluginOf(replace->type);
  }
}

Result<FrameworkElement*> Application::CreateModule(std::string_view type, const std::string& name) {
  return CreateModule(type, element(), name);
}

Result<FrameworkElement*> Application::CreateModule(std::string_view type, FrameworkElement& parent,
                                                    const std::string& name) {
  parts_->LoadPluginOf(type);
  return parts_->plugins().modules().Create(type, parent, name);
}

Result<void> Application::AddThread(const std::string& name, const ThreadOptions& options) {
  return Attempt([&]() -> Result<void> {
    CreateThread(parts_->runtime(), name, options);
    return {};
  });
}

Result<void> Application::Assign(std::string_view path, const std::string& thread) {
  return Apply({AssignToThread{std::string(path), thread}}).ToResult();
}

Result<void> Application::Connect(std::string_view from, std::string_view to, const ConnectOptions& options) {
  const NewFeeds feeds(parts_->runtime());
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
  const RobotStop::AsOf as_of = LetsMove(changes) ? parts_->runtime().robot_stop().AsOfNow() : RobotStop::AsOf();
  parts_->LoadPluginsOf(changes);
  std::string text;
  for (const Change& change : changes) text += (text.empty() ? "" : "; ") + ChangeText(change);
  ChangeOutcome outcome = parts_->history->Apply(changes, {}, {}, {}, as_of);
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

ChangeOutcome Application::Swap(const std::string& path, const std::string& type, std::vector<Setting> settings) {
  return Apply({ReplaceModule{.path = path, .type = type, .settings = std::move(settings)}});
}

ChangeOutcome Application::Undo() { return parts_->history->Undo(parts_->runtime().robot_stop().AsOfNow()); }
ChangeOutcome Application::Redo() { return parts_->history->Redo(parts_->runtime().robot_stop().AsOfNow()); }

Result<void> Application::PublishByHand(std::string_view port, std::string_view value) {
  const auto set = SetPortByHand(parts_->runtime(), std::string(port), std::string(value));
  return set ? Result<void>() : set.error();
}

Result<void> Application::Release(std::string_view port) {
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
      return set.error().WithPath((*found)->path());
    }
  }
  return Apply({SetParameter{std::string(path), std::string(value)}}).ToResult();
}

Result<std::string> Application::Get(std::string_view path) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const auto found = PathSearch(parts_->runtime()).Find(path, PathKind::kParameter);
  if (!found) return found.error();
  const auto* const parameter = dynamic_cast<const Configurable*>(*found);
  if (parameter == nullptr) return IsAnother(**found, "a parameter");
  return parameter->ToText();
}

bool Application::Parts::IsOwnFile(const std::filesystem::path& file) {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto found = FindAgain();
  return !found || internal::IsOwnFile(**found, file);
}

Result<void> Application::Save(const std::filesystem::path& file, bool overwrites) {
  if (!overwrites && !parts_->IsOwnFile(file)) {
    if (auto lost = internal::WhatIsLost(file)) return *lost;
  }
  const auto lost = parts_->Save(file);
  if (!lost) return lost.error();
  if (!lost->empty()) parts_->Add({ApplicationEvent::Kind::kNotice, *lost});
  return {};
}

Result<std::string> Application::Parts::Save(const std::filesystem::path& file) {
  const std::lock_guard no_reload(reloading);
  std::unique_lock lock(runtime().structure_mutex());
  auto found = FindAgain();
  if (!found) return found.error();
  const bool is_own = internal::IsOwnFile(**found, file);
  lock.unlock();
  auto lost = SaveApplication(runtime(), **found, {plugins(), tags()}, file);
  if (!lost) return lost;
  lock.lock();
  if (found = FindAgain(); !found) return lost;
  const std::string passing = internal::WhatPasses(**found, *scheduler, KeepsStop(stop_file.get(), is_own));
  return *lost + (lost->empty() || passing.empty() ? "" : "\n") + passing;
}

Result<std::string> Application::SaveConfiguration(const std::filesystem::path& file) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const auto found = parts_->FindAgain();
  if (!found) return found.error();
  return runnel::SaveConfiguration(**found, file);
}

bool Application::is_deleted() {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  return !parts_->FindAgain();
}

Result<void> Application::LoadPlugin(std::string_view plugin) { return parts_->LoadPlugin(plugin); }

ChangeOutcome Application::Reload(const std::string& plugin) {
  const RobotStop::AsOf as_of = parts_->runtime().robot_stop().AsOfNow();
  const std::lock_guard one_at_a_time(parts_->reloading);
  return ReloadPlugin(parts_->plugins(), *parts_->editor, parts_->runtime(), plugin, as_of);
}

CommandService& Application::service() {
  if (parts_->service) return *parts_->service;
  ServiceHooks hooks = parts_->hooks;
  hooks.load_plugins = [this](const ChangeSet& changes) { parts_->LoadPluginsOf(changes); };
  hooks.library_of = [this](const std::string& plugin) -> std::string {
    const auto file = plugins().FindFile(plugin);
    return file ? file->string() : "";
  };
  hooks.save = [this](const std::string& file) -> Result<std::string> {
    const std::string done = "saved " + parts_->path() + (file.empty() ? "" : " to " + file);
    const auto lost = parts_->Save(file);
    if (!lost) return lost;
    if (!lost->empty()) parts_->Add({ApplicationEvent::Kind::kNotice, *lost});
    return lost->empty() ? done : done + "\n" + *lost;
  };
  hooks.preview_save = [this](const std::string& file) {
    auto difference = [&] {
      const std::lock_guard lock(parts_->runtime().structure_mutex());
      const auto found = parts_->FindAgain();
      return found ? internal::TextToSave(**found, {parts_->plugins(), parts_->tags()}, file) : found.error();
    }();
    if (!difference) return difference;
    const auto read = internal::ReadBefore(*difference);
    return read ? difference : Result<ServiceHooks::SaveDifference>(read.error());
  };
  hooks.find_overwritten = [this](const SaveRequest& request) -> std::optional<Error> {
    if (!request.is_configuration && parts_->IsOwnFile(request.file)) return {};
    return internal::WhatIsLost(request.file);
  };
  hooks.save_configuration = [this](const std::string& file) { return SaveConfiguration(file); };
  hooks.set_paused = [this](const std::string& path, bool is_paused) { return is_paused ? Pause(path) : Resume(path); };
  if (!hooks.quit) {
    hooks.quit = [this]() -> Result<std::string> {
      RequestStop();
      return std::string("ends");
    };
  }
  for (auto* const ends : {&hooks.quit, &hooks.restart}) {
    if (!*ends) continue;
    *ends = [this, end = *ends]() -> Result<std::string> {
      std::string lost;
      try {  // a type whose text throws does not keep the run from its end, nor does whoever has the lock
        const auto lock = TryStructureLock(parts_->runtime(), std::chrono::milliseconds(200));
        if (!lock) lost = "\nwhat is not saved cannot be told while the structure is being changed";
        const auto found = lock ? parts_->FindAgain() : Error{};
        if (found) {
          lost = internal::WhatEnds(**found, *parts_->scheduler, {parts_->plugins(), parts_->tags()},
                                    KeepsStop(parts_->stop_file.get()));
        }
      } catch (...) {
        lost = "\nwhat is not saved cannot be told";
      }
      auto ended = end();
      return ended ? Result<std::string>(*ended + lost) : ended;
    };
  }
  hooks.reload = [this](const std::string& plugin) -> Result<std::string> {
    std::string done = "loaded " + plugin + " anew";
    if (const auto reloaded = Reload(plugin).ToResult(); !reloaded) return reloaded.error();
    AwaitProof(*parts_->editor, parts_->scheduler->pace());
    return done;
  };
  return parts_->service.emplace(ServedApplication{parts_->runtime(), parts_->plugins().modules(), *parts_->editor,
                                                   *parts_->log, std::move(hooks), &*parts_->history,
                                                   &parts_->scheduler->pace(), &*parts_->scheduler});
}

}  // namespace runnel
