#pragma once

#include <concepts>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/element/runtime.h"
#include "core/paths/path_search.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/application/application_description.h"
#include "plugins/parameters/parameter.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {

class ApplicationLog;
class ChangeHistory;
class CommandService;
class LoadedApplication;
class PluginManager;
class RunReport;
class Supervisor;
class XmlTagRegistry;

namespace internal {

/// What somebody who asks for such a thing expects at a path, and what it is called in errors.
struct FoundKind {
  PathKind kind;
  std::string name;
};
template <typename T>
FoundKind FoundKindOf(std::type_identity<T>) {
  return {PathKind::kElement, "what was asked for"};
}
template <typename T>
FoundKind FoundKindOf(std::type_identity<Output<T>>) {
  return {PathKind::kOutput, "an output of type " + TypeOf<T>().name()};
}
template <typename T>
FoundKind FoundKindOf(std::type_identity<Input<T>>) {
  return {PathKind::kInput, "an input of type " + TypeOf<T>().name()};
}
template <typename T>
FoundKind FoundKindOf(std::type_identity<Parameter<T>>) {
  return {PathKind::kParameter, "a parameter of type " + TypeOf<T>().name()};
}
template <typename T>
FoundKind FoundKindOf(std::type_identity<StaticParameter<T>>) {
  return {PathKind::kParameter, "a static parameter of type " + TypeOf<T>().name()};
}

}  // namespace internal

/// Something that has happened to an application and that a person should read.
struct ApplicationEvent {
  enum class Kind { kWarning, kFault, kNotice, kFailure, kMessage };
  Kind kind = Kind::kWarning;
  std::string text;                 ///< whole lines, with place and path
  std::optional<Fault> fault = {};  ///< of kFault
};

/// What ends a run besides a verdict, an extension, a fault rule and RequestStop().
struct RunOptions {
  std::optional<Duration> limit = {};  ///< on the application's clock
  /// Called after each simulated cycle, and some fifty times a real second while none runs. True: it is
  /// over.
  std::function<bool(Duration so_far)> is_over = {};
};

/// An application: its elements, what runs them, and what changes them. See README.md for its life.
///
///     auto application = Application::Load("robot.xml", {.settings = {{"goal_x", "4"}}});
///     if (!application) return Fail(application.diagnostics().ToString());
///     application->Start();
///     application->Swap("/robot/planner", "planning/bug1");
///
/// Several live in one process and know nothing of each other. Paths are as changes have them: the name of the
/// application may be left out, and of ports and parameters the group's.
///
/// Ownership:  of everything in it. Ports, parameters and elements that are found live until they are deleted,
///             replaced, or the application is destroyed.
/// Threads:    Start(), Stop(), Run(), RunUntil(), RunCycles() and destroying from one thread at a time; the rest
///             from any. None from within a cycle, none under the structure lock.
/// Allocation: yes. Cycles allocate nothing for it.
/// Errors:     of one thing, the Result; of files and change sets, all of them at once. Plugins' exceptions
///             become errors.
class Application {
 public:
  /// Loads an application file and makes it ready to run. Nothing runs yet.
  [[nodiscard]] static LoadedApplication Load(const std::filesystem::path& file, ApplicationOptions options = {});
  /// The same for a text; errors call it `name`. Relative file names in it start in `folder`.
  [[nodiscard]] static LoadedApplication LoadText(std::string_view text, ApplicationOptions options = {},
                                                  const std::filesystem::path& folder = {},
                                                  const std::string& name = "application");
  /// An empty one, to be composed in code: see Create(). Made ready by MakeReady() or by what runs it.
  [[nodiscard]] static LoadedApplication Compose(const std::string& name, ApplicationOptions options = {});
  /// What `describe` constructs, in whichever way.
  [[nodiscard]] static LoadedApplication LoadFrom(const ApplicationDescription::Describe& describe,
                                                  ApplicationOptions options = {});

  /// Stops, and ends what reaches it from outside.
  ~Application();

  // Composing in code. Elements are configured and connected until MakeReady(); what is created later is
  // ready at once by Apply().

  /// The group that all of the application is in.
  [[nodiscard]] FrameworkElement& element() const noexcept;
  [[nodiscard]] const std::string& name() const noexcept;
  template <std::derived_from<FrameworkElement> T, typename... Arguments>
  T& Create(FrameworkElement& parent, std::string name, Arguments&&... arguments) {
    return runtime().Create<T>(parent, std::move(name), std::forward<Arguments>(arguments)...);
  }
  /// In the application itself. Throws what T's constructor throws, ElementError among it.
  template <std::derived_from<FrameworkElement> T, typename... Arguments>
  T& Create(std::string name, Arguments&&... arguments) {
    return Create<T>(element(), std::move(name), std::forward<Arguments>(arguments)...);
  }
  /// A module of a registered type; loads the plugin that the type's name begins with. Errors: no such type,
  /// with the nearest; a bad or taken name.
  Result<FrameworkElement*> CreateModule(std::string_view type, const std::string& name);
  Result<FrameworkElement*> CreateModule(std::string_view type, FrameworkElement& parent, const std::string& name);
  /// A thread; the one made first runs all that is assigned to none.
  Result<void> AddThread(const std::string& name, const ThreadOptions& options);
  Result<void> Assign(std::string_view path, const std::string& thread);
  Result<void> Connect(std::string_view from, std::string_view to, const ConnectOptions& options = {});
  /// What is not ready yet becomes so. Errors: what an element says that could not be prepared.
  Result<void> MakeReady();

  // Running.

  /// Lets it run, until Stop(), in threads of its own. Errors: it cannot be made ready; it runs already.
  Result<void> Start();
  /// Ends all cycles. Idempotent; it can be started again.
  void Stop();
  /// Start() has been called, and neither Stop() nor an end that the application itself has requested came since.
  [[nodiscard]] bool is_running() const noexcept;

  /// Runs in the calling thread, on either clock, until a limit, its run monitors, an extension, a fault rule,
  /// RequestStop() or `is_over` ends it. How long it ran on its clock. Errors: there is nothing to run.
  Result<Duration> Run(const RunOptions& options = {});
  /// Simulated time: runs all cycles that are due before `end` of its clock, no faster than its speed allows,
  /// in the calling thread. Errors: a real clock, a pause; its end has been requested.
  Result<void> RunUntil(Time end);
  Result<void> RunFor(Duration duration) { return RunUntil(runtime().clock().Now() + duration); }
  /// So many cycles, each the one that is due next, with what its data sets off. Errors: as RunUntil(), and
  /// nothing to run.
  Result<void> RunCycles(std::uint64_t count);

  /// While it runs on simulated time. Errors: a real clock.
  Result<void> Pause();
  Result<void> Resume();
  /// Lets so many further cycles run and then pauses.
  Result<void> Step(std::uint64_t cycles = 1);
  Result<void> SetSpeed(double speed);
  /// What the clock shows that `<clock type="outside"/>` follows. Errors: see Pace::SetTime().
  Result<void> SetTime(Time time);
  /// Leaves all at or below the path, or all that a thread of this path runs, out of cycles, on either clock; then does
  /// what the file says (`<on_pause>`). Errors: no such element; a cycle that does not end.
  Result<void> Pause(std::string_view path);
  /// Takes that back. Errors: it is not what has been paused.
  Result<void> Resume(std::string_view path);
  /// Any thread, also from a signal handler.
  void RequestStop() noexcept;

  // What happens to it.

  /// Since the last call, oldest first; the oldest are gone if there are very many. While it runs they come
  /// within some 20 ms.
  [[nodiscard]] std::vector<ApplicationEvent> TakeEvents();
  /// The verdicts of its run monitors. From the thread that runs it, or while none does.
  [[nodiscard]] RunReport& report() noexcept;
  [[nodiscard]] ApplicationLog& log() noexcept;
  /// Tells extensions that no cycle will run any more, and how the run was.
  void NoteEnd(const std::string& verdict);

  // Changing it.

  /// All of the changes between two cycles, or none; loads the plugins that the names of types begin with. Can be undone.
  /// What may let something move is not done, here and below, if STOP was pressed or released since it was called.
  ChangeOutcome Apply(const ChangeSet& changes);
  /// The same from text, see change_text.h: "replace /robot/planner with planning/bug1".
  ChangeOutcome Apply(std::string_view text);
  /// Puts a module of `type` in the place of another one.
  ChangeOutcome Swap(const std::string& path, const std::string& type, std::vector<Setting> settings = {});
  ChangeOutcome Undo();
  ChangeOutcome Redo();
  /// Parameters in text format. Errors: no such parameter, with the nearest; not a value of it.
  Result<void> Set(std::string_view path, std::string_view value);
  [[nodiscard]] Result<std::string> Get(std::string_view path);
  /// Sets the value at a port by hand, in text format: readers find it instead of what is published, until it is
  /// released. Errors: no such port, with the nearest; not a value of its type.
  Result<void> PublishByHand(std::string_view port, std::string_view value);
  /// Errors: no such port; it is not set by hand.
  Result<void> Release(std::string_view port);
  /// Saves what it is now to the file; "": the one that it came from. What is replaced is kept as FILE~. Errors: the
  /// file is there and not its own, unless it `overwrites`; what cannot be saved.
  Result<void> Save(const std::filesystem::path& file = {}, bool overwrites = false);
  /// Writes values of parameters that have changed back to the configuration files; with a `file`, all that the
  /// configuration may set into that one. Errors: as configuration_saver.h. Says what was done.
  Result<std::string> SaveConfiguration(const std::filesystem::path& file = {});
  /// Whether somebody has deleted the whole of it, so that nothing is left to run.
  [[nodiscard]] bool is_deleted();
  /// Loads a plugin, or loads it anew and makes its modules anew by it.
  Result<void> LoadPlugin(std::string_view plugin);
  ChangeOutcome Reload(const std::string& plugin);

  // Looking into it.

  /// Output<T>, Input<T>, Parameter<T>, a module's class … by path. Lives until it is deleted or replaced: to
  /// follow a port through swaps, see InputFrom() and OutputTo(). Errors: nothing there, with the nearest name;
  /// something else.
  template <typename T>
  [[nodiscard]] Result<T*> Find(std::string_view path) {
    const internal::FoundKind wanted = internal::FoundKindOf(std::type_identity<T>());
    const auto found = FindElement(path, wanted.kind);
    if (!found) return found.error();
    if (auto* const it = dynamic_cast<T*>(*found)) return it;
    return IsAnother(**found, wanted.name);
  }
  /// A copy of the newest value at a port; nullopt: none yet. Errors: no such port, another type.
  template <typename T>
  [[nodiscard]] Result<std::optional<T>> Read(std::string_view path) {
    std::optional<T> value;
    const auto looked =
        LookAt(path, TypeOf<T>(), [&](const void* newest, Time) { value = *static_cast<const T*>(newest); });
    if (!looked) return looked.error();
    return value;
  }
  /// An input beside the application that reads what the port at `path` publishes, also after swaps; with a queue,
  /// each value of it. It is the application's; one thread at a time uses it.
  template <typename T>
  [[nodiscard]] Result<Input<T>*> InputFrom(std::string_view path, const ConnectOptions& options = {}) {
    return TieTo<Input<T>>(path, PathKind::kOutput, options, "in");
  }
  /// An output beside the application that is connected to the input at `path`, also after swaps. One thread at a
  /// time publishes to it, outside of cycles.
  template <typename T>
  [[nodiscard]] Result<Output<T>*> OutputTo(std::string_view path, const ConnectOptions& options = {}) {
    return TieTo<Output<T>>(path, PathKind::kInput, options, "out");
  }

  // Its parts, for extensions and for those who know what they do.

  [[nodiscard]] Runtime& runtime() const noexcept;
  [[nodiscard]] Scheduler& scheduler() noexcept;
  [[nodiscard]] Supervisor& supervisor() noexcept;
  [[nodiscard]] StructureEditor& editor() noexcept;
  [[nodiscard]] ChangeHistory& history() noexcept;
  [[nodiscard]] PluginManager& plugins() noexcept;
  [[nodiscard]] XmlTagRegistry& tags() noexcept;
  [[nodiscard]] const ApplicationOptions& options() const noexcept;
  [[nodiscard]] const Extensions& extensions() const noexcept;
  /// "0.1.0", of the library.
  [[nodiscard]] static const char* Version() noexcept;
  /// What it came from, absolute; "" if from no file.
  [[nodiscard]] const std::string& file() const noexcept;
  [[nodiscard]] const std::string& text() const noexcept;
  /// What carries out its clients' requests. From Begin() of extensions on; made when it is first asked for.
  [[nodiscard]] CommandService& service();

 private:
  struct Parts;
  explicit Application(ApplicationOptions options);
  static LoadedApplication Make(const std::function<bool(Parts&)>& describe, ApplicationOptions options);

  Result<FrameworkElement*> FindElement(std::string_view path, PathKind kind);
  static Error IsAnother(const FrameworkElement& found, const std::string& wanted);
  Result<void> LookAt(std::string_view path, const TypeInfo& type, const Port::Visitor& look);
  // Makes a port beside the application and ties it to the one at `path`.
  Result<void> Tie(std::string_view path, PathKind kind, const ConnectOptions& options,
                   const std::function<std::unique_ptr<Port>(FrameworkElement& group)>& make);
  template <typename Made>
  Result<Made*> TieTo(std::string_view path, PathKind kind, const ConnectOptions& options, const char* name) {
    Made* made = nullptr;
    const auto tied = Tie(path, kind, options, [&](FrameworkElement& group) {
      auto port = std::make_unique<Made>(group, name);
      made = port.get();
      return port;
    });
    if (!tied) return tied.error();
    return made;
  }
  // Before any cycle in simulated time.
  Result<void> BeginCycles();
  void NoteStart();
  // Gathers what has happened.
  void Attend();
  void LogProfile();
  [[nodiscard]] bool IsOver();

  const std::unique_ptr<Parts> parts_;
};

/// What has come of loading: an application, or all that is wrong.
class LoadedApplication {
 public:
  [[nodiscard]] bool has_value() const noexcept { return application_ != nullptr; }
  explicit operator bool() const noexcept { return has_value(); }
  /// Precondition: has_value().
  Application& operator*() const noexcept { return *application_; }
  Application* operator->() const noexcept { return application_.get(); }
  /// To be owned elsewhere.
  [[nodiscard]] std::unique_ptr<Application> Take() noexcept { return std::move(application_); }

  /// All errors, and warnings also of what has been loaded.
  [[nodiscard]] const Diagnostics& diagnostics() const noexcept { return diagnostics_; }
  /// The first error. Precondition: !has_value().
  [[nodiscard]] const Error& error() const { return diagnostics_.errors().front(); }

 private:
  friend class Application;
  std::unique_ptr<Application> application_;
  Diagnostics diagnostics_;
};

}  // namespace runnel
