// runnel._extension.Application: what runnel.Application in Python is made of.

#include <chrono>
#include <mutex>
#include <thread>

#include <pybind11/stl.h>

#include "apps/python/extension/access.h"
#include "apps/python/extension/bindings.h"
#include "apps/python/extension/errors.h"
#include "apps/python/extension/ports.h"
#include "core/paths/path_search.h"
#include "plugins/application/run_report.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/change_task.h"
#include "plugins/command_service/command_service.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

using Words = std::vector<std::pair<std::string, std::string>>;

Result<void> Block(Application& application, const std::string& path) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  const auto port = PathSearch(application.runtime()).FindPort(path, PathKind::kElement);
  return port ? (*port)->Block() : port.error();
}

// Without a lock, by whichever thread. What has no control socket keeps no STOP.
Result<void> SetStop(Application& application, bool is_pressed) {
  RobotStop& stop = application.runtime().robot_stop();
  if (auto done = is_pressed ? Result<void>() : stop.Release("Python"); !done) return done;
  if (is_pressed) stop.Press("Python");
  auto all = is_pressed ? CheckThatAllStops(application.runtime(), &application.scheduler()) : Result<void>();
  const auto is_kept =
      application.options().has_control ? application.service().application().hooks.is_stop_kept : nullptr;
  if (all && is_kept && !is_kept()) {
    return Error{.message = std::string(is_pressed ? "STOP is in force" : "the STOP is released") +
                            ", and the next process would not know of it yet"};
  }
  return all;
}

Open Load(const std::string& kind, const std::string& text, const std::string& folder, const Words& settings,
          const std::vector<std::string>& configurations, const std::vector<std::string>& plugin_folders,
          const std::string& clock, std::optional<double> speed, bool is_paused, bool has_control,
          const std::vector<std::pair<std::string, Words>>& extensions) {
  using ClockKind = SchedulerOptions::ClockKind;
  CheckMayWait();
  ApplicationOptions options{.has_control = has_control, .keeps_stop = has_control};
  for (const auto& [name, value] : settings) options.settings.emplace_back(name, value);
  options.configurations = configurations;
  for (const auto& each : plugin_folders) options.plugin_folders.emplace_back(each);
  if (!clock.empty()) options.clock = clock == "real" ? ClockKind::kReal : ClockKind::kSimulated;
  options.speed = speed;
  options.is_paused = is_paused;
  options.speed_words = "speed=";
  options.pause_words = "paused=";
  for (const auto& [name, arguments] : extensions) options.extensions_by_name.push_back({name, {arguments}});
  const auto open = std::make_shared<OpenApplication>();
  Diagnostics diagnostics;
  WithoutGil([&] {
    const Counted call(this_thread_place.calls);
    auto loaded = kind == "file"   ? Application::Load(text, options)
                  : kind == "text" ? Application::LoadText(text, options, folder)
                                   : Application::Compose(text, options);
    diagnostics = loaded.diagnostics();
    if (loaded) {
      // The application is the first of the two to end.
      const auto both = std::make_shared<std::pair<std::shared_ptr<NameChanges>, std::unique_ptr<Application>>>(
          open->names, loaded.Take());
      both->second->runtime().AddListener(*both->first);
      open->application = {both, both->second.get()};
    }
    if (kind == "compose" && open->application) {
      if (auto ready = open->application->MakeReady(); !ready) diagnostics.Add(ready.error());
    }
  });
  if (!diagnostics.ok()) Throw(diagnostics);
  Warn(diagnostics.warnings());
  return open;
}

// A method: what the application refuses is raised.
template <typename Told, typename... Words>
auto Calling(Told (Application::*act)(Words...)) {
  return [act](const Open& open, Words... words) {
    auto told = WithoutGil(open, [&](Application& it) { return (it.*act)(words...); });
    if constexpr (std::is_same_v<Told, ChangeOutcome>) return Check(told);
    if constexpr (!std::is_same_v<Told, ChangeOutcome>) return Checked(std::move(told));
  };
}

// The call that runs the application, or starts and ends it: one at a time.
class Running {
 public:
  explicit Running(const Open& open) : open_(*open) {
    if (open_.runs_in != std::thread::id())
      Throw({.message = "another call runs the application", .hint = "quit() ends it"});
    open_.runs_in = std::this_thread::get_id();
    open_.is_quit = false;
  }
  ~Running() { open_.runs_in = {}; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  /// Between cycles: after quit(), close() or what a signal has thrown, which are looked at now and then.
  bool IsOver() {
    if (open_.is_quit || open_.is_forked || this_thread_place.interrupt) return true;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return false;
    last_ = now;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) this_thread_place.interrupt = std::make_exception_ptr(py::error_already_set());
    return this_thread_place.interrupt != nullptr;
  }

 private:
  OpenApplication& open_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

double Run(const Open& open, std::optional<double> limit) {
  const Use use(*open);
  Running running(open);
  RunOptions options;
  if (limit) options.limit = FromSeconds(*limit);
  options.is_over = [&](Duration) { return running.IsOver(); };
  auto ran = WithoutGil(open, [&](Application& application) { return application.Run(options); });
  LookAround(*open);
  return ToSeconds(Checked(std::move(ran)));
}

// Runs cycles that are due before `end`, at most so many.
void RunCycles(const Open& open, std::optional<Duration> length, std::uint64_t most) {
  constexpr Duration kLongestWait = std::chrono::milliseconds(20);
  using StepResult = Scheduler::StepResult;
  const Use use(*open);
  Running running(open);
  Checked(WithoutGil(open, [&](Application& application) -> Result<void> {
    if (auto ready = application.RunCycles(0); !ready) return ready;
    std::optional<Time> end;
    if (length) end = application.runtime().clock().Now() + *length;
    StepResult result = StepResult::kCycle;
    while ((result == StepResult::kCycle || result == StepResult::kTimeout) && most > 0 && !running.IsOver()) {
      result = application.scheduler().Advance(end, kLongestWait);
      if (result == StepResult::kCycle && !end) --most;
    }
    const bool is_refused = result == StepResult::kStopped || (result == StepResult::kEnd && !end);
    return application.RunCycles(is_refused ? 1 : 0);  // says why
  }));
  LookAround(*open);
}

void RunFor(const Open& open, double seconds) {
  if (!(seconds >= 0)) throw py::value_error("run_for() takes a number of seconds that is not negative");
  RunCycles(open, FromSeconds(seconds), 1);
}

void Quit(const Open& open) {
  if (open->is_closed) return;
  open->is_quit = true;
  if (open->runs_in == std::this_thread::get_id()) return;  // in update() or a signal handler, within the call
  CheckMayWait();
  const Use use(*open);
  AwaitWithGil([&] {
    LookAround(*open);
    return open->runs_in == std::thread::id();
  });
  const Running running(open);
  WithoutGil([&] { use->Stop(); });
}

// Of a component's attribute its next cycle says what it makes of the value, if something else than this thread runs cycles.
void Set(const Open& open, const std::string& path, const std::string& value) {
  Checked(WithoutGil(open, [&](Application& application) { return application.Set(path, value); }));
  const Use use(*open);
  const auto is_run = [&] {
    const bool in_call = open->runs_in != std::thread::id() && open->runs_in != std::this_thread::get_id();
    return (in_call || use->is_running()) && !use->scheduler().pace().is_paused();
  };
  for (const Time end = SteadyClock().Now() + kLongestSetting; is_run() && SteadyClock().Now() < end;) {
    if (const auto said = WithoutGil([&] { return OutcomeOf(use->runtime(), path); })) return Checked(*said);
    WithoutGil([] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
    LookAround(*open);
  }
}

}  // namespace

void Step(const Open& open, std::uint64_t cycles) {
  const Use use(*open);
  if (!use->is_running()) return RunCycles(open, {}, cycles);
  Checked(WithoutGil(open, [&](Application& application) { return application.Step(cycles); }));
}

void BindApplication(py::module_& module) {
  py::class_<OpenApplication, Open>(module, "Application")
      .def(py::init(&Load))
      .def("_apply",
           [](const Open& open, const std::string& text) {
             Check(WithoutGil(open, [&](Application& it) { return it.Apply(text); }));
           })
      .def("_undo", Calling(&Application::Undo))
      .def("_redo", Calling(&Application::Redo))
      .def("_reload", Calling(&Application::Reload))
      .def("_load_plugin", Calling(&Application::LoadPlugin))
      .def("_set", Set)
      .def("_get", Get)
      .def("_save",
           [](const Open& open, const std::string& file, bool overwrite) {
             Checked(WithoutGil(open, [&](Application& it) { return it.Save(file, overwrite); }));
           })
      .def("_read_input", ReadInput)
      .def("_reader", [](const Open& open, const std::string& path,
                         std::size_t queue) { return std::make_shared<Reader>(open, path, queue); })
      .def("_writer",
           [](const Open& open, const std::string& path) {
             return std::make_shared<TiedPort>(open, path, PathKind::kInput, ConnectOptions{});
           })
      .def("_publish", PublishByHand)
      .def("_release", Calling(&Application::Release))
      .def("_block",
           [](const Open& open, const std::string& path) {
             Checked(WithoutGil(open, [&](Application& it) { return Block(it, path); }));
           })
      .def("_robot_stop",
           [](const Open& open, bool is_pressed) {
             // Also while close() waits for calls under way: cycles go on until then.
             const auto application = open->application ? open->application : open->Get();
             Checked(WithoutGil([&] { return SetStop(*application, is_pressed); }));
           })
      .def("_call", Call)
      .def("_run", Run)
      .def("_run_for", RunFor)
      .def("_step", Step)
      .def("_start",
           [](const Open& open) {
             const Running running(open);
             Checked(WithoutGil(open, [&](Application& it) { return it.Start(); }));
           })
      .def("_quit", Quit)
      .def("_pause",
           [](const Open& open, const std::optional<std::string>& path) {
             Checked(WithoutGil(open, [&](Application& it) { return path ? it.Pause(*path) : it.Pause(); }));
           })
      .def("_resume",
           [](const Open& open, const std::optional<std::string>& path) {
             Checked(WithoutGil(open, [&](Application& it) { return path ? it.Resume(*path) : it.Resume(); }));
           })
      .def("_set_speed", Calling(&Application::SetSpeed))
      .def("_close", [](const Open& open) { open->Close(); })
      .def("_leave", [](const Open& open) { open->Leave(); })
      .def("_paths", Paths)
      .def("_log", Log)
      .def("_events", Events)
      .def("_verdicts",
           [](const Open& open) {
             return WithoutGil(
                 open, [&](Application& it) { return std::pair(it.report().Verdicts(), it.report().IsGood()); });
           })
      .def_property_readonly(
          "is_running", [](const Open& open) { return !open->is_closed && open->application->is_running(); },
          "start() has been called, and the run has not ended since.")
      .def_property_readonly("name", [](const Open& open) { return Use(*open)->name(); })
      .def_property_readonly(
          "file", [](const Open& open) { return Use(*open)->file(); }, "Where it came from; '' if from no file.")
      .def_property_readonly(
          "time",
          [](const Open& open) {
            const Use use(*open);
            return ToSeconds(use->runtime().clock().Now() - use->log().start());
          },
          "How long it has been running on its clock (s).");
  module.def("await_all", AwaitAll);
  module.def("forked", BeginAsChild);
  module.attr("version") = Application::Version();
}

}  // namespace runnel::python
