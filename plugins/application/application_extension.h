#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/plugin/plugin_registry.h"
#include "plugins/application/application_options.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/command_service/command_service.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

class Application;

/// What is added to an application that can do without it, by a plugin (ExtensionRegistry) or by the program that
/// runs it. Each function is called at its point of the application's life, in this order; all of them do nothing
/// unless they are overridden.
///
/// Ownership:  shared by the application's options and whoever wants to ask it something; what it has of the
///             application it gives back in End() and Release().
/// Threads:    up to Begin(), the thread that loads; then the one that runs the application; End() and
///             Release() by the one that destroys it. Never within a cycle, nor under the structure lock.
/// Errors:     an error or an exception of Build() to Begin() makes loading fail, and leaves nothing.
class ApplicationExtension {
 public:
  virtual ~ApplicationExtension() = default;

  /// A file of another form than Runnel's, or an application without a file (nullptr): builds it with kConstruct.
  /// nullopt: of a form that it does not know.
  virtual std::optional<BuildOutcome> Build(const ApplicationFile* /*file*/, const BuildTools& /*tools*/) {
    return std::nullopt;
  }
  /// The application is described, and nothing of it is ready. `options` make the scheduler next.
  virtual Result<void> Prepare(FrameworkElement& /*application*/, SchedulerOptions& /*options*/) { return {}; }
  /// What clients of the control socket and viewers may do besides.
  virtual void AddHooks(Application& /*application*/, ServiceHooks& /*hooks*/) {}
  /// All is ready, and nothing runs yet. Warnings go to `diagnostics`.
  virtual Result<void> Begin(Application& /*application*/, Diagnostics& /*diagnostics*/) { return {}; }

  /// What people are told once all has begun: where to look at it, for one. Whole lines.
  [[nodiscard]] virtual std::string StartText() const { return {}; }
  /// Just before the first cycle.
  virtual void OnStart() {}
  /// How long the application is to run at most, on its clock.
  [[nodiscard]] virtual std::optional<Duration> limit() const { return std::nullopt; }
  /// Whether the run is over, asked some fifty times a second; nullopt: its run monitors decide.
  virtual std::optional<bool> IsOver() { return std::nullopt; }
  /// Whether values come from a recording, known from the beginning: whoever reaches others, or is reached by them, stays
  /// away then.
  [[nodiscard]] virtual bool Replays() const { return false; }
  /// What has gone wrong here since the last call, and did not end the run.
  virtual std::optional<Error> TakeFailure() { return std::nullopt; }
  /// No cycle will run any more: brings what it does to an end, and says in whole lines what has come of it. What
  /// goes wrong is an error, and the run has failed.
  virtual std::string Finish(Diagnostics& /*problems*/) { return {}; }
  /// After that; `verdict` is what has come of the run, for people.
  virtual void OnEnd(const std::string& /*verdict*/) {}
  /// The process is about to end by a crash: brings to the disk what can be. Called by a thread that is none of the
  /// application's, while cycles may run on, and while the thread that has crashed may hold any lock.
  virtual void OnCrash() {}
  /// The user wants to look at what has come of the run before the application goes.
  [[nodiscard]] virtual bool IsHeld() const { return false; }

  /// The application goes; no cycle runs any more. Lets go of all that is of it ...
  virtual void End() noexcept {}
  /// ... but for what the scheduler uses, which has gone by now.
  virtual void Release() noexcept {}
};

using Extensions = std::vector<std::shared_ptr<ApplicationExtension>>;

/// What plugins make of their options: one extension, or several that begin in this order. Errors: what is
/// wrong with a value.
using ExtensionFactory = std::function<Result<Extensions>(const ExtensionArguments& arguments)>;

/// The extensions that plugins bring. One of a plugin, by its name:
///
///     RUNNEL_PLUGIN(tracing, registry) {
///       if (auto* extensions = registry.Find<ExtensionRegistry>()) extensions->Add(MakeTrace);
///     }
///
/// Threads: not thread-safe.
class ExtensionRegistry final : public OfferedRegistry {
 public:
  /// Throws ElementError if the plugin has added one already.
  void Add(ExtensionFactory factory);
  std::function<void()> SetAside(std::string_view plugin) override;
  void set_plugin(const std::string& plugin) override { plugin_ = plugin; }

  /// Errors: the plugin is loaded, and has none; what the factory says, or throws.
  [[nodiscard]] Result<Extensions> Make(const std::string& plugin, const ExtensionArguments& arguments) const;

 private:
  std::map<std::string, ExtensionFactory, std::less<>> factories_;
  std::string plugin_;
};

}  // namespace runnel
