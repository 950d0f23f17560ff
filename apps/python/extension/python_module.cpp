#include "apps/python/extension/python_module.h"

#include <algorithm>
#include <filesystem>
#include <mutex>

#include <pybind11/stl.h>

#include "apps/python/extension/bindings.h"
#include "apps/python/extension/errors.h"
#include "apps/python/extension/ports.h"
#include "apps/python/extension/value.h"
#include "core/element/source_place.h"
#include "plugins/parameters/parameter.h"
#include "plugins/python/python_types.h"
#include "plugins/scheduling/thread_container.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

py::object Helper(const char* name) { return py::module_::import("runnel._modules").attr(name); }

// Files that nobody has loaded yet are looked for beside the application's.
std::string FolderOf(const FrameworkElement& element) {
  const SourcePosition place = FindSourcePlace(element);
  return place.file.empty() ? "" : std::filesystem::absolute(place.file).parent_path().string();
}

Error ErrorOf(const py::error_already_set& thrown) {
  const py::object told = Helper("error_of")(thrown.value(), thrown.trace());
  const auto [message, file, line, hint] = told.cast<std::tuple<std::string, std::string, int, std::string>>();
  Error error{.message = message, .hint = hint};
  if (!file.empty()) error.position = {file, line};
  return error;
}

template <typename T>
std::unique_ptr<FrameworkElement> MakeParameter(Module& module, const std::string& name, const py::dict& said) {
  ParameterOptions<T> options;
  options.default_value = said["default"].cast<T>();
  options.unit = said["unit"].cast<std::string>();
  options.description = said["description"].cast<std::string>();
  if constexpr (Bounded<T>) {
    if (!said["lowest"].is_none()) options.bounds.lowest = said["lowest"].cast<T>();
    if (!said["highest"].is_none()) options.bounds.highest = said["highest"].cast<T>();
  }
  return std::make_unique<Parameter<T>>(&module, name, options);
}

}  // namespace

PythonModule& ModuleHost::Get() const {
  if (module == nullptr) throw py::value_error("the module is gone");
  return *module;
}

template <typename Work>
void PythonModule::WithPython(const Work& work) {
  const py::gil_scoped_acquire gil;
  try {
    work();
  } catch (const py::error_already_set& thrown) {
    Error error = ErrorOf(thrown);
    if (error.path.empty()) error.path = path();
    throw ElementError(error);
  } catch (const py::builtin_exception& thrown) {
    throw ElementError({.message = thrown.what(), .path = path()});
  }
}

PythonModule::PythonModule(const Placement& placement, const std::string& type) : Module(placement) {
  host_->module = this;
  const std::string folder = FolderOf(placement.parent);
  try {
    WithPython([&] {
      class_ = Helper("find_class")(type, folder).release();
      MakeParameters(Helper("describe")(class_).cast<py::dict>());
    });
  } catch (...) {
    const py::gil_scoped_acquire gil;
    class_.dec_ref();
    throw;
  }
  KeepState(attributes_);
}

PythonModule::~PythonModule() {
  if (Py_IsInitialized() == 0) return;  // the process ends
  const py::gil_scoped_acquire gil;
  host_->module = nullptr;
  for (py::handle each : {update_, object_, class_}) each.dec_ref();
}

void PythonModule::MakeParameters(const py::dict& described) {
  for (const auto& [name, options] : described["parameters"].cast<py::dict>()) {
    const auto said = options.cast<py::dict>();
    const auto kind = said["kind"].cast<std::string>();
    const auto called = name.cast<std::string>();
    parameters_.push_back(kind == "bool"    ? MakeParameter<bool>(*this, called, said)
                          : kind == "int"   ? MakeParameter<std::int64_t>(*this, called, said)
                          : kind == "float" ? MakeParameter<double>(*this, called, said)
                          : kind == "str"   ? MakeParameter<std::string>(*this, called, said)
                                            : MakeParameter<std::vector<double>>(*this, called, said));
  }
}

Result<void> PythonModule::Construct() {
  WithPython([&] {
    const auto described = Helper("describe")(class_).cast<py::dict>();
    const auto each = [&](const char* direction, const auto& make) {
      for (const auto& [name, options] : described[direction].cast<py::dict>()) {
        const auto said = options.template cast<py::dict>();
        const TypeInfo& type = TypeNamed(said["type"].template cast<std::string>());
        const TypedPorts* const ports = FindTypedPorts(type);
        if (ports == nullptr) Throw({.message = "nobody makes ports of type " + type.name(), .path = path()});
        make(*ports, name.template cast<std::string>(), said);
      }
    };
    each("inputs", [&](const TypedPorts& ports, const std::string& name, const py::dict& said) {
      inputs_.push_back({ports.MakeInput(InputGroup(), name,
                                         {.description = said["description"].cast<std::string>(),
                                          .required = said["required"].cast<bool>(),
                                          .trigger = said["trigger"].cast<bool>(),
                                          .unit = said["unit"].cast<std::string>()}),
                         &ports});
    });
    each("outputs", [&](const TypedPorts& ports, const std::string& name, const py::dict& said) {
      auto port = ports.MakeOutput(OutputGroup(), name, {.description = said["description"].cast<std::string>(), .unit = said["unit"].cast<std::string>()});
      if (!port) Throw({.message = "only a module in C++ can make values of type " + said["type"].cast<std::string>(), .path = path()});
      outputs_.push_back(std::move(port));
    });
    object_ = Helper("make")(class_, host_, path()).release();
    update_ = object_.attr("update").cast<py::object>().release();
  });
  return {};
}

Result<void> PythonModule::Prepare() {
  GoToOwnThread();
  WithPython([&] { (void)object_.attr("prepare")(); });
  return {};
}

// Unless the module itself is assigned: what it costs is then its user's choice.
void PythonModule::GoToOwnThread() {
  const std::lock_guard lock(runtime().structure_mutex());
  if (OwnThread(*this) != nullptr) return;
  std::optional<double> period;
  WithPython([&] { period = class_.attr("period").cast<std::optional<double>>(); });
  KeepOthersTogether();
  std::string own = path().substr(path().find('/', 1) + 1);
  std::replace(own.begin(), own.end(), '/', '_');
  own = "python_" + own;
  FrameworkElement* const threads = runtime().root().FindChild("threads");
  auto* thread = threads != nullptr ? dynamic_cast<ThreadContainer*>(threads->FindChild(own)) : nullptr;
  if (thread == nullptr) {
    ThreadOptions options;
    if (period) options.period = FromSeconds(*period);
    if (!period) options.activation = ThreadOptions::Activation::kTrigger;
    thread = &CreateThread(runtime(), own, options);
  }
  AssignThread(*this, *thread, AssignedBy::kNobody);
}

// What is assigned to none goes on where it is run: with one more thread nobody would have said where.
void PythonModule::KeepOthersTogether() {
  std::vector<ThreadContainer*> threads;
  runtime().root().Visit([&](FrameworkElement& each) {
    if (auto* const thread = dynamic_cast<ThreadContainer*>(&each)) threads.push_back(thread);
  });
  if (threads.empty()) threads.push_back(&CreateThread(runtime(), "main"));
  FrameworkElement* application = this;
  while (application->parent()->parent() != nullptr) application = application->parent();
  if (threads.size() == 1 && AssignedThread(*application) == 0) AssignThread(*application, *threads.front(), AssignedBy::kNobody);
}

void PythonModule::Update() {
  const py::gil_scoped_acquire gil;
  try {
    const auto returned = py::reinterpret_steal<py::object>(PyObject_CallNoArgs(update_.ptr()));
    if (!returned) throw py::error_already_set();
  } catch (const py::error_already_set& thrown) {
    const auto [summary, whole] = Helper("fault_of")(thrown.value(), thrown.trace()).cast<std::pair<std::string, std::string>>();
    log().Error("{}", whole);
    throw std::runtime_error(summary);
  }
}

py::object PythonModule::ParameterValue(std::size_t index) const {
  const auto& parameter = dynamic_cast<const Configurable&>(*parameters_.at(index));
  return ToPlain(parameter.type(), parameter.Value().get());
}

void PythonModule::Say(const std::string& level, const std::string& text) {
  if (level == "debug") log().Debug("{}", text);
  if (level == "info") log().Info("{}", text);
  if (level == "warning") log().Warn("{}", text);
  if (level == "error") log().Error("{}", text);
}

PythonModule::Attributes& PythonModule::Attributes::operator=(const Attributes& from) {
  const py::gil_scoped_acquire gil;
  if (module->object_ && from.module->object_) Helper("take_over")(module->object_, from.module->object_);
  return *this;
}

namespace {

Result<ModuleType> FindModuleType(std::string_view name) {
  const std::string type(name);
  return ModuleType{.name = type,
                    .summary = "written in Python",
                    .plugin = "python",
                    .make = [type](const Placement& placement) -> std::unique_ptr<FrameworkElement> {
                      return std::make_unique<PythonModule>(placement, type);
                    }};
}

// One of the inputs as update() has it.
struct InputOfModule {
  std::shared_ptr<ModuleHost> host;
  std::size_t index;
  ValueTimes times{};

  py::object Take(bool (HeldValues::*how)(Port&, std::size_t) noexcept, bool only_new) {
    PythonModule::BoundInput& input = host->Get().input(index);
    auto held = input.ports->MakeHeldValues(1);
    const bool is_new = (held.get()->*how)(*input.port, 0);
    if (held->Find(0) == nullptr || (only_new && !is_new)) return py::none();
    times = held->times(0);
    return HeldToPython(input.port->type(), std::move(held));
  }
};

struct OutputOfModule {
  std::shared_ptr<ModuleHost> host;
  std::size_t index;
};

}  // namespace

void BindModules(py::module_& module) {
  py::class_<ModuleHost, std::shared_ptr<ModuleHost>>(module, "ModuleHost")
      .def("parameter", [](const ModuleHost& host, std::size_t index) { return host.Get().ParameterValue(index); })
      .def("input", [](const std::shared_ptr<ModuleHost>& host, std::size_t index) { return InputOfModule{host, index}; })
      .def("output", [](const std::shared_ptr<ModuleHost>& host, std::size_t index) { return OutputOfModule{host, index}; })
      .def("now", [](const ModuleHost& host) { return ToSeconds(host.Get().Now()); })
      .def("period", [](const ModuleHost&) { return ToSeconds(PythonModule::Period()); })
      .def("say", [](const ModuleHost& host, const std::string& level, const std::string& text) { host.Get().Say(level, text); });
  py::class_<InputOfModule>(module, "ModuleInput", "An input of a module in Python, as its update() reads it.")
      .def("read", [](InputOfModule& input) { return input.Take(&HeldValues::Read, false); }, "The newest value; None if there is none yet.")
      .def("new", [](InputOfModule& input) { return input.Take(&HeldValues::Read, true); }, "The newest value, unless it has been read; else None.")
      .def("next", [](InputOfModule& input) { return input.Take(&HeldValues::Next, true); }, "Of a connection with a queue the oldest that waits; None if none does.")
      .def_property_readonly("timestamp", [](const InputOfModule& input) { return ToSeconds(input.times.timestamp); },
                             "When the last value was measured (s).");
  py::class_<OutputOfModule>(module, "ModuleOutput", "An output of a module in Python.")
      .def("publish",
           [](const OutputOfModule& output, const py::args& positional, const py::kwargs& named) {
             PublishFromPython(output.host->Get().output(output.index), positional, named, std::nullopt);
           },
           "publish(value) or publish(x=1, y=2): writes the value into a buffer that the port lends, and publishes that.")
      .def("publish_measured",
           [](const OutputOfModule& output, double timestamp, const py::object& value) {
             PublishFromPython(output.host->Get().output(output.index), py::make_tuple(value), {}, timestamp);
           },
           "The same of what was measured at `timestamp` (s, of the application's clock).");
  static const ModuleTypes types{&FindModuleType};
  module.attr("module_types") = py::capsule(&types, ModuleTypes::kCapsule);
}

}  // namespace runnel::python
