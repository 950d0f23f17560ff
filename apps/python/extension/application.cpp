// runnel._extension.Application: what runnel.Application in Python is made of.

#include <chrono>
#include <mutex>

#include <pybind11/stl.h>

#include "apps/python/extension/access.h"
#include "apps/python/extension/bindings.h"
#include "apps/python/extension/errors.h"
#include "apps/python/extension/ports.h"
#include "core/paths/path_search.h"
#include "core/port/driving_ports.h"
#include "plugins/application/run_report.h"
#include "plugins/command_service/application_log.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

using Words = std::vector<std::pair<std::string, std::string>>;

struct LoadWords {
  Words settings;
  std::vector<std::string> configurations;
  std::vector<std::string> plugin_folders;
  std::string clock;
  std::optional<double> speed;
  bool is_paused;
  bool has_control;
  std::vector<std::pair<std::string, Words>> extensions;
};

ApplicationOptions OptionsOf(const LoadWords& words) {
  ApplicationOptions options;
  for (const auto& [name, value] : words.settings) options.settings.emplace_back(name, value);
  options.configurations = words.configurations;
  for (const auto& each : words.plugin_folders) options.plugin_folders.emplace_back(each);
  if (!words.clock.empty()) {
    if (words.clock != "real" && words.clock != "simulated") {
      Throw({.message = "there is no clock '" + words.clock + "'", .hint = "there is 'real', 'simulated'"});
    }
    options.clock = words.clock == "real" ? SchedulerOptions::ClockKind::kReal : SchedulerOptions::ClockKind::kSimulated;
  }
  options.speed = words.speed;
  options.is_paused = words.is_paused;
  options.speed_words = "speed=";
  options.pause_words = "paused=";
  options.has_control = words.has_control;
  for (const auto& [name, arguments] : words.extensions) options.extensions_by_name.push_back({name, {arguments}});
  return options;
}

Result<void> Block(Application& application, const std::string& path) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  const auto port = PathSearch(application.runtime()).FindPort(path, PathKind::kElement);
  return port ? (*port)->Block() : port.error();
}

// Without a lock, by whichever thread.
Result<void> SetStop(Application& application, bool is_pressed) {
  RobotStop& stop = application.runtime().robot_stop();
  if (!is_pressed) return stop.Release("Python");
  stop.Press("Python");
  if (FindWhatDrives(application.runtime()) == "") return NothingDrives();
  return {};
}

Open Load(const std::string& kind, const std::string& text, const std::string& folder, const LoadWords& words) {
  const ApplicationOptions options = OptionsOf(words);
  const auto open = std::make_shared<OpenApplication>();
  Diagnostics diagnostics;
  WithoutGil([&] {
    auto loaded = kind == "file"   ? Application::Load(text, options)
                  : kind == "text" ? Application::LoadText(text, options, folder)
                                   : Application::Compose(text, options);
    diagnostics = loaded.diagnostics();
    if (loaded) open->application = loaded.Take();
    if (kind == "compose" && open->application) {
      if (auto ready = open->application->MakeReady(); !ready) diagnostics.Add(ready.error());
    }
  });
  if (!diagnostics.ok()) {
    WithoutGil([&] { open->application.reset(); });
    Throw(diagnostics);
  }
  for (const Error& warning : diagnostics.warnings()) {
    if (PyErr_WarnEx(PyExc_UserWarning, warning.ToString().c_str(), 2) != 0) throw py::error_already_set();
  }
  return open;
}

// What carries out changes: with the plugins that they need.
void Apply(const Open& open, const ChangeSet& changes) {
  Application& application = **open;
  Check(WithoutGil([&] {
    for (const Change& each : changes) {
      const auto* const create = std::get_if<CreateModule>(&each);
      if (create == nullptr) continue;
      const std::lock_guard lock(application.runtime().structure_mutex());
      const std::size_t slash = create->type.find('/');
      if (slash != std::string::npos && application.plugins().modules().Find(create->type) == nullptr) {
        (void)application.plugins().Load(create->type.substr(0, slash));
      }
    }
    return application.Apply(changes);
  }));
}

std::vector<Setting> SettingsOf(const Words& words) {
  std::vector<Setting> settings;
  for (const auto& [name, value] : words) settings.push_back({name, value});
  return settings;
}

// With the groups that are not there yet.
void Create(const Open& open, const std::string& path, const std::string& type, const Words& settings) {
  Application& application = **open;
  const std::string root = "/" + application.name();
  std::string whole = path.starts_with('/') ? path : root + "/" + path;
  if (!whole.starts_with(root + "/")) whole = root + whole;
  ChangeSet changes;
  WithoutGil([&] {
    const std::lock_guard lock(application.runtime().structure_mutex());
    for (std::size_t slash = whole.find('/', root.size() + 1); slash != std::string::npos; slash = whole.find('/', slash + 1)) {
      if (!application.runtime().root().Find(whole.substr(0, slash))) changes.push_back(CreateGroup{whole.substr(0, slash)});
    }
  });
  if (type.empty()) {
    changes.push_back(CreateGroup{whole});
  } else {
    changes.push_back(CreateModule{whole, type, SettingsOf(settings)});
  }
  Apply(open, changes);
}

// Looks at Ctrl-C now and then, between cycles.
class SignalCheck {
 public:
  bool operator()() {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return false;
    last_ = now;
    const py::gil_scoped_acquire gil;
    return has_come = has_come || PyErr_CheckSignals() != 0;
  }
  bool has_come = false;

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

double Run(const Open& open, std::optional<double> limit) {
  SignalCheck signals;
  RunOptions options;
  if (limit) options.limit = FromSeconds(*limit);
  options.is_over = [&](Duration) { return signals(); };
  auto ran = WithoutGil([&] { return (*open)->Run(options); });
  if (signals.has_come) throw py::error_already_set();
  return ToSeconds(Checked(std::move(ran)));
}

void RunFor(const Open& open, double seconds) {
  constexpr Duration kSlice = std::chrono::seconds(1);
  const Time end = (*open)->runtime().clock().Now() + FromSeconds(seconds);
  for (bool is_over = false; !is_over;) {
    const Time next = std::min(end, (*open)->runtime().clock().Now() + kSlice);
    is_over = next == end;
    Checked(WithoutGil([&] { return (*open)->RunUntil(next); }));
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void Connect(const Open& open, const std::string& from, const std::string& to, std::size_t queue,
             const std::string& on_full, bool pull, bool late, const std::string& convert) {
  ConnectOptions options{.queue = queue, .pull = pull, .late = late, .convert = convert};
  const auto& names = OnFullNames();
  const auto named = std::find(names.begin(), names.end(), on_full);
  if (named == names.end()) throw py::value_error("on_full is one of drop_oldest, drop_newest, refuse");
  options.on_full = static_cast<OnFull>(named - names.begin());
  Apply(open, {ConnectPorts{from, to, options}});
}

void AddThreadOf(const Open& open, const std::string& name, std::optional<double> period, int priority) {
  ThreadOptions options{.priority = priority};
  if (period) options.period = FromSeconds(*period);
  if (!period) options.activation = ThreadOptions::Activation::kTrigger;
  Apply(open, {AddThread{name, options}});
}

}  // namespace

void BindApplication(py::module_& module) {
  using Wanted = std::vector<std::pair<std::string, Words>>;
  py::class_<OpenApplication, Open>(module, "Application")
      .def(py::init([](const std::string& kind, const std::string& text, const std::string& folder, const Words& settings,
                       const std::vector<std::string>& configurations, const std::vector<std::string>& plugin_folders,
                       const std::string& clock, std::optional<double> speed, bool paused, bool control, const Wanted& extensions) {
        return Load(kind, text, folder, {settings, configurations, plugin_folders, clock, speed, paused, control, extensions});
      }))
      .def("_create", Create)
      .def("_connect", Connect)
      .def("_thread", AddThreadOf)
      .def("_assign", [](const Open& open, const std::string& path, const std::string& thread) { Apply(open, {AssignToThread{path, thread}}); })
      .def("_disconnect", [](const Open& open, const std::string& from, const std::string& to) { Apply(open, {DisconnectPorts{from, to}}); })
      .def("_delete", [](const Open& open, const std::string& path) { Apply(open, {DeleteElement{path}}); })
      .def("_apply", [](const Open& open, const std::string& text) { Check(WithoutGil([&] { return (*open)->Apply(text); })); })
      .def("_swap",
           [](const Open& open, const std::string& path, const std::string& type, const Words& settings) {
             Check(WithoutGil([&] { return (*open)->Swap(path, type, SettingsOf(settings)); }));
           })
      .def("_undo", [](const Open& open) { Check(WithoutGil([&] { return (*open)->Undo(); })); })
      .def("_redo", [](const Open& open) { Check(WithoutGil([&] { return (*open)->Redo(); })); })
      .def("_reload", [](const Open& open, const std::string& plugin) { Check(WithoutGil([&] { return (*open)->Reload(plugin); })); })
      .def("_load_plugin", [](const Open& open, const std::string& plugin) { Checked(WithoutGil([&] { return (*open)->LoadPlugin(plugin); })); })
      .def("_set",
           [](const Open& open, const std::string& path, const std::string& value) {
             Checked(WithoutGil([&] { return (*open)->Set(path, value); }));
           })
      .def("_get", Get)
      .def("_save",
           [](const Open& open, const std::string& file, bool overwrite) {
             Checked(WithoutGil([&] { return (*open)->Save(file, overwrite); }));
           })
      .def("_read_input", ReadInput)
      .def("_reader", [](const Open& open, const std::string& path, std::size_t queue) { return std::make_shared<Reader>(open, path, queue); })
      .def("_writer", [](const Open& open, const std::string& path) { return std::make_shared<TiedPort>(open, path, PathKind::kInput, ConnectOptions{}); })
      .def("_publish", PublishByHand)
      .def("_release", [](const Open& open, const std::string& path) { Checked(WithoutGil([&] { return (*open)->Release(path); })); })
      .def("_block", [](const Open& open, const std::string& path) { Checked(WithoutGil([&] { return Block(**open, path); })); })
      .def("_robot_stop", [](const Open& open, bool is_pressed) { Checked(WithoutGil([&] { return SetStop(**open, is_pressed); })); })
      .def("_call", Call)
      .def("_run", Run)
      .def("_run_for", RunFor)
      .def("_step", Step)
      .def("_start", [](const Open& open) { Checked(WithoutGil([&] { return (*open)->Start(); })); })
      .def("_quit", [](const Open& open) { WithoutGil([&] { if (open->application) open->application->Stop(); }); })
      .def("_pause", [](const Open& open, const std::optional<std::string>& path) {
        Checked(WithoutGil([&] { return path ? (*open)->Pause(*path) : (*open)->Pause(); }));
      })
      .def("_resume", [](const Open& open, const std::optional<std::string>& path) {
        Checked(WithoutGil([&] { return path ? (*open)->Resume(*path) : (*open)->Resume(); }));
      })
      .def("_set_speed", [](const Open& open, double speed) { Checked(WithoutGil([&] { return (*open)->SetSpeed(speed); })); })
      .def("_close",
           [](const Open& open) {
             WithoutGil([&] {
               if (open->application) {
                 open->application->Stop();
                 Diagnostics problems;
                 for (const auto& each : open->application->extensions()) (void)each->Finish(problems);
               }
               open->application.reset();
             });
           })
      .def("_paths", Paths)
      .def("_log", Log)
      .def("_events", Events)
      .def("_verdicts", [](const Open& open) {
        return WithoutGil([&] { return std::pair((*open)->report().Verdicts(), (*open)->report().IsGood()); });
      })
      .def_property_readonly("is_running", [](const Open& open) { return open->application && open->application->is_running(); },
                             "start() has been called, and it has not been stopped since.")
      .def_property_readonly("name", [](const Open& open) { return (*open)->name(); })
      .def_property_readonly("file", [](const Open& open) { return (*open)->file(); }, "Where it came from; '' if from no file.")
      .def_property_readonly("time", [](const Open& open) {
        return ToSeconds((*open)->runtime().clock().Now() - (*open)->log().start());
      }, "How long it has been running on its clock (s).");
  module.attr("version") = Application::Version();
}

}  // namespace runnel::python
