#pragma once

#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/element/attempt.h"
#include "core/module/executable.h"
#include "core/module/group.h"
#include "core/port/typed_ports.h"
#include "core/types/duration_text.h"
#include "core/types/type_info.h"
#include "plugins/application/application.h"
#include "plugins/application/application_extension.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recording_info.h"
#include "plugins/recording/recording_names.h"
#include "plugins/recording/recording_player.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace internal {

// Real threads publish the last values in their next cycle.
constexpr Duration kLastCycle = std::chrono::seconds(1);

// Stands for whatever published there; the player takes the place of its task.
class RecordedModule final : public FrameworkElement {
 public:
  explicit RecordedModule(const Placement& placement) : FrameworkElement(placement, ElementKind::kModule) {
    Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
      return {{this, Phase::kUpdate, BoundCall::To<&RecordedModule::DoNothing>(*this), {}, {this}}};
    }));
  }
  void DoNothing() {}
};

// The types of all ports that the modules of plugins have.
inline void MakeTypesKnown(const BuildTools& tools) {
  // What cannot be loaded has its say where it is asked for.
  for (const std::string& plugin : tools.plugins.Available()) (void)tools.plugins.Load(plugin);
  Runtime scratch;
  for (const ModuleType* type : tools.plugins.modules().All()) {
    (void)tools.plugins.modules().CreateSample(type->name, scratch.root());
  }
}

using Parts = std::vector<std::string>;

// How many of the parts lead to the module that a port is of: all but the port and its group.
inline std::size_t ModuleDepth(const std::string& path, const Parts& parts) {
  return parts.size() - (PlainPortPath(path) == path ? 1 : 2);
}

// Puts ports where they were recorded, and around them what had them.
class RecordedTree {
 public:
  RecordedTree(const McapContents& contents, Runtime& runtime) : runtime_(runtime) {
    for (const auto& [id, channel] : contents.channels) {
      const std::string path = PortOf(channel);
      Parts parts = PartsOf(path);
      if (parts.size() < 2 || IsView(channel)) continue;
      parts.resize(ModuleDepth(path, parts));
      modules_.insert(std::move(parts));
    }
  }

  // Throws ElementError where names are none, or are taken.
  Result<void> Add(const std::string& path, const std::string& type) {
    const Parts parts = PartsOf(path);
    if (parts.size() < 2) return Error{.message = "is no path of a port", .path = path};
    const std::size_t depth = ModuleDepth(path, parts);
    FrameworkElement* parent = &runtime_.root();
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      FrameworkElement* const known = parent->FindChild(parts[i]);
      parent = known != nullptr
                   ? known
                   : &Make(*parent, {parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i) + 1}, i >= depth);
    }
    const TypeInfo* const known_type = FindType(type);
    const TypedPorts* const ports = known_type != nullptr ? FindTypedPorts(*known_type) : nullptr;
    auto port = ports != nullptr ? ports->MakeOutput(*parent, parts.back()) : nullptr;
    if (port == nullptr) {
      return Error{.message = "no plugin here has ports of type '" + type + "'",
                   .path = path,
                   .hint = "is RUNNEL_PLUGIN_PATH set to the folder of the plugin that has it?"};
    }
    runtime_.Adopt(std::unique_ptr<FrameworkElement>(std::move(port)));
    return {};
  }

 private:
  FrameworkElement& Make(FrameworkElement& parent, const Parts& parts, bool is_port_group) {
    if (is_port_group) return runtime_.Create<PortGroup>(parent, parts.back());
    if (modules_.contains(parts)) return runtime_.Create<RecordedModule>(parent, parts.back());
    return runtime_.Create<Group>(parent, parts.back());
  }

  Runtime& runtime_;
  std::set<Parts> modules_;
};

// As BuildApplication() with kConstruct. Errors: no recording; none of its types is known.
inline BuildOutcome BuildRecordedPorts(const std::string& file, const BuildTools& tools) {
  BuildOutcome outcome;
  const auto reader = McapReader::Open(file);
  if (!reader) {
    outcome.diagnostics.Add(reader.error());
    return outcome;
  }
  MakeTypesKnown(tools);
  Runtime& runtime = tools.runtime;
  const McapContents& contents = (*reader)->contents();
  RecordedTree tree(contents, runtime);
  std::vector<Error> failures;
  for (const auto& [id, channel] : contents.channels) {
    if (IsView(channel)) continue;
    const auto schema = contents.schemas.find(channel.schema);
    const std::string type = schema != contents.schemas.end() ? schema->second.name : "";
    if (auto made = Attempt([&, &each = channel] { return tree.Add(PortOf(each), type); }); !made) {
      failures.push_back(made.error());
      continue;
    }
    outcome.application = runtime.root().FindChild(PartsOf(PortOf(channel)).front());
  }
  if (outcome.application == nullptr) {
    outcome.diagnostics.Add(failures.empty()
                                ? Error{.message = "there are no ports in this recording", .position = {file}}
                                : failures.front());
    return outcome;
  }
  for (Error& failure : failures) outcome.diagnostics.AddWarning(std::move(failure));
  // As fine as anybody can see.
  CreateThread(runtime, "player", {.period = std::chrono::milliseconds(5)});
  return outcome;
}

class ApplicationReplay final : public ApplicationExtension {
 public:
  ApplicationReplay(std::string file, PlayerOptions options) : file_(std::move(file)), options_(std::move(options)) {}

  std::optional<BuildOutcome> Build(const ApplicationFile* file, const BuildTools& tools) override {
    if (file != nullptr) return std::nullopt;
    return BuildRecordedPorts(file_, tools);
  }

  Result<void> Prepare(FrameworkElement& /*application*/, SchedulerOptions& options) override {
    is_simulated_ = options.clock == SchedulerOptions::ClockKind::kSimulated;
    if (is_simulated_) options.speed = 1;
    return {};
  }

  Result<void> Begin(Application& application, Diagnostics& diagnostics) override {
    const auto warn = [&](std::string message) {
      diagnostics.AddWarning({.message = std::move(message), .position = {file_}});
    };
    runtime_ = &application.runtime();
    scheduler_ = &application.scheduler();
    auto reader = McapReader::Open(file_);
    if (!reader) return reader.error();
    const auto& contents = (*reader)->contents();
    if (contents.damage) {
      warn("played is what comes before its damage: " + contents.damage->message);
    }
    was_simulated_ = AboutText(**reader, "clock") == "simulated";
    auto player = Player::Prepare(*runtime_, std::move(*reader), options_);
    if (!player) return player.error();
    player_ = std::move(*player);
    std::string missing;
    for (const std::string& path : player_->missing()) missing += " " + path;
    if (!missing.empty()) warn("not played, for the application does not have:" + missing);
    return {};
  }

  // Simulated time goes on where the recording was, so that values bear the times that they bore.
  void OnStart() override {
    if (is_simulated_ && was_simulated_) scheduler_->simulated_clock().Set(player_->start());
    player_->Start(runtime_->clock().Now());
  }

  [[nodiscard]] std::optional<Duration> limit() const override {
    if (options_.loops) return {};
    // Simulated cycles that are due at the very end have not run when it is reached.
    return player_->length() + (is_simulated_ ? Duration(1) : kLastCycle);
  }

  std::optional<bool> IsOver() override { return player_->failure() || (!is_simulated_ && player_->is_over()); }

  std::string Finish(Diagnostics& problems) override {
    if (const auto failure = player_->failure()) problems.Add(*failure);
    const std::size_t ports = player_->ports();
    return "replayed " + DurationText(player_->length()) + (options_.loops ? ", again and again: " : ": ") +
           std::to_string(player_->published()) + " values at " + std::to_string(ports) +
           (ports == 1 ? " port" : " ports") +
           (player_->calls() > 0 ? ", " + std::to_string(player_->calls()) + " calls\n" : "\n");
  }

  [[nodiscard]] bool Replays() const override { return true; }
  void End() noexcept override { player_.reset(); }

 private:
  const std::string file_;
  const PlayerOptions options_;
  Runtime* runtime_ = nullptr;
  Scheduler* scheduler_ = nullptr;
  std::unique_ptr<Player> player_;
  bool is_simulated_ = false;
  bool was_simulated_ = false;  // when it was recorded
};

}  // namespace internal

/// Plays a recording into an application instead of what its modules publish.
///
///     auto application = Application::Load("robot.xml",
///         {.extensions_by_name = {{"recording", {{{"recording", "run.mcap"}, {"ports", "laser/scan"}}}}}});
///     application->Run();   // until all has been played
///
/// Without an application file, ports are made for all that is recorded, with the paths that were recorded, so that it can
/// be replayed without the application that it is of: `echo`, viewers and recorders find them. Types come from the plugins
/// that can be found; what is of none of them is left out, with a warning.
/// Simulated time passes as real time does unless the options say otherwise, and goes on where the recording was.
/// Errors: of loading: see McapReader::Open(), Player::Prepare(); without a file, that none of its types is known. What
/// cannot be played is a warning.
[[nodiscard]] inline std::shared_ptr<ApplicationExtension> MakeReplay(std::string file, PlayerOptions options) {
  return std::make_shared<internal::ApplicationReplay>(std::move(file), std::move(options));
}

}  // namespace runnel
