#include "apps/python/extension/python_module.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <mutex>

#include <pybind11/stl.h>

#include "apps/python/extension/errors.h"
#include "apps/python/extension/value.h"
#include "core/element/file_notes.h"
#include "core/module/kept_state.h"
#include "plugins/parameters/parameter.h"
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
  const py::object trace = thrown.trace() ? py::object(thrown.trace()) : py::object(py::none());
  const py::object told = Helper("error_of")(thrown.value(), trace);
  const auto [message, file, line, hint] = told.cast<std::tuple<std::string, std::string, int, std::string>>();
  Error error{.message = message, .hint = hint};
  if (!file.empty()) error.position = {file, line};
  return error;
}

template <template <typename> typename Kind, typename T>
std::unique_ptr<FrameworkElement> MakeParameterOf(Module& module, const std::string& name, const py::dict& said) {
  ParameterOptions<T> options{.default_value = said["default"].cast<T>(),
                              .unit = said["unit"].cast<std::string>(),
                              .description = said["description"].cast<std::string>()};
  if constexpr (Bounded<T>) {
    if (!said["lowest"].is_none()) options.bounds.lowest = said["lowest"].cast<T>();
    if (!said["highest"].is_none()) options.bounds.highest = said["highest"].cast<T>();
  }
  return WithoutGil([&] { return std::make_unique<Kind<T>>(&module, name, options); });
}

template <typename T>
std::unique_ptr<FrameworkElement> MakeParameter(Module& module, const std::string& name, const py::dict& said) {
  return said.contains("is_static") ? MakeParameterOf<StaticParameter, T>(module, name, said)
                                    : MakeParameterOf<Parameter, T>(module, name, said);
}

}  // namespace

ModuleHost::Use ModuleHost::Get() {
  if (born != forks) throw py::value_error("the module runs in the process that this one was forked from");
  // A use within another one goes on: while one is left, whoever holds the ports waits. He may wait for this very thread.
  const auto may_begin = [this] { return holds == 0 || module == nullptr || (this_thread_place.uses > 0 && uses > 0); };
  if (!may_begin() && this_thread_place.uses > 0) throw py::value_error("another module is just taking its place");
  AwaitWithGil(may_begin);
  if (module == nullptr) throw py::value_error("the module is gone");
  return {.module = module, .use = Counted(uses)};
}

std::shared_ptr<void> ModuleHost::Hold() {
  constexpr auto kLongest = std::chrono::seconds(2);  // for which others stand still
  const auto end = std::chrono::steady_clock::now() + kLongest;
  const GilInCycle gil;
  ++holds;
  std::shared_ptr<void> held(nullptr, [host = shared_from_this()](void*) { --host->holds; });
  AwaitWithGil([&] {
    if (uses > 0 && std::chrono::steady_clock::now() > end) throw std::runtime_error("a thread still uses its ports");
    return uses == 0;
  });
  return held;
}

template <typename Work>
void PythonModule::WithPython(const Work& work) {
  const GilInCycle gil;
  try {
    work();
  } catch (const py::error_already_set& thrown) {
    (void)KeepInterrupt(thrown);
    Error error = ErrorOf(thrown);
    if (error.path.empty()) error.path = path();
    throw ElementError(error);
  } catch (const py::builtin_exception& thrown) {
    throw ElementError({.message = thrown.what(), .path = path()});
  }
}

PythonModule::PythonModule(const Placement& placement, const std::string& type) : Module(placement) {
  host_->module = this;
  Annotate(std::make_unique<BeforeHandOver>([this] { return host_->Hold(); }));
  KeepState(attributes_);
  const std::string folder = FolderOf(placement.parent);
  try {
    WithPython([&] {
      class_ = Helper("find_class")(type, folder).release();
      MakeParameters(Helper("parameters_of")(class_).cast<py::dict>());
    });
  } catch (...) {
    const GilInCycle gil;
    class_.dec_ref();
    throw;
  }
}

PythonModule::~PythonModule() {
  if (Py_IsInitialized() == 0) {  // the process ends
    for (auto& each : services_) (void)each.release();
    for (auto& each : clients_) (void)each.release();
    return;
  }
  {
    const GilInCycle gil;
    host_->module = nullptr;
    AwaitWithGil([this] { return host_->uses == 0; });
  }
  // Without the GIL, for which their threads may be waiting.
  services_.clear();
  clients_.clear();
  if (makes_thread_ && !has_run_) LeaveNoThread();
  const GilInCycle gil;
  for (py::handle each : {update_, object_, class_}) each.dec_ref();
}

void PythonModule::MakeParameters(const py::dict& described) {
  for (const auto& [name, options] : described) {
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
    object_ = Helper("make")(class_, host_, path()).release();
    const auto described = Helper("ports_of")(object_).cast<py::dict>();
    MakePorts(described);
    MakeServices(described);
    Helper("begin")(object_, described);
    update_ = object_.attr("update").cast<py::object>().release();
  });
  return {};
}

void PythonModule::MakePorts(const py::dict& described) {
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
    const InputOptions options{.description = said["description"].cast<std::string>(),
                               .required = said["required"].cast<bool>(),
                               .trigger = said["trigger"].cast<bool>(),
                               .unit = said["unit"].cast<std::string>(),
                               .ageing = said["set_once"].cast<bool>() ? Ageing::kSetOnce : Ageing::kTimesOut};
    const InputTimeout::Options timeout{.seconds = said["timeout"].cast<double>(), .log = &log()};
    const bool times_out = options.ageing == Ageing::kTimesOut && !Find("parameter/" + name + "_timeout");
    inputs_.push_back(WithoutGil([&] {
      BoundInput input{ports.MakeInput(InputGroup(), name, options), &ports, nullptr};
      if (times_out) input.timeout = std::make_unique<InputTimeout>(this, *input.port, timeout);
      return input;
    }));
  });
  each("outputs", [&](const TypedPorts& ports, const std::string& name, const py::dict& said) {
    const OutputOptions options{.description = said["description"].cast<std::string>(),
                                .unit = said["unit"].cast<std::string>()};
    auto port = WithoutGil([&] { return ports.MakeOutput(OutputGroup(), name, options); });
    if (!port)
      Throw({.message = "only a module in C++ can make values of type " + said["type"].cast<std::string>(),
             .path = path()});
    outputs_.push_back(std::move(port));
  });
}

void PythonModule::MakeServices(const py::dict& described) {
  for (const auto& [name, said] : described["clients"].cast<py::dict>()) {
    clients_.push_back(std::make_unique<ModuleClient>(InputGroup(), name.cast<std::string>(), said.cast<py::dict>(),
                                                      [this](const py::error_already_set& thrown) { Fail(thrown); }));
  }
  for (const auto& [name, said] : described["services"].cast<py::dict>()) {
    services_.push_back(std::make_unique<ModuleService>(OutputGroup(), name.cast<std::string>(), said.cast<py::dict>(),
                                                        [this](const std::string& text) { log().Error("{}", text); }));
    services_.back()->SetHandler(object_.attr(name.cast<std::string>().c_str()));
  }
}

Result<void> PythonModule::Prepare() {
  WithPython([&] { (void)object_.attr("prepare")(); });
  GoToOwnThread();  // last: what throws leaves no thread behind
  return {};
}

// Unless the module itself is assigned: what it costs is then its user's choice.
void PythonModule::GoToOwnThread() {
  const std::lock_guard lock(runtime().structure_mutex());
  if (OwnThread(*this) != nullptr) return;
  std::optional<double> period;
  WithPython([&] { period = class_.attr("period").cast<std::optional<double>>(); });
  KeepOthersTogether();
  own_thread_ = "python_" + path().substr(path().find('/', 1) + 1);
  std::replace(own_thread_.begin(), own_thread_.end(), '/', '_');
  FrameworkElement* const threads = runtime().root().FindChild("threads");
  auto* thread = threads != nullptr ? dynamic_cast<ThreadContainer*>(threads->FindChild(own_thread_)) : nullptr;
  if (thread == nullptr) {
    ThreadOptions options;
    if (period) options.period = FromSeconds(*period);
    if (!period) options.activation = ThreadOptions::Activation::kTrigger;
    makes_thread_ = true;  // also if that fails halfway
    thread = &CreateThread(runtime(), own_thread_, options);
  }
  AssignThread(*this, *thread, AssignedBy::kNobody);
}

void PythonModule::LeaveNoThread() noexcept {
  // Nothing is deleted under the one, nor waited for with the other.
  if (runtime().structure_mutex().HeldByThisThread() || PyGILState_Check() != 0) return;
  try {
    UnlistedElement gone;
    {
      const ChangeScope all_at_once(runtime());
      FrameworkElement& root = runtime().root();
      FrameworkElement* const threads = root.FindChild("threads");
      auto* const thread =
          threads != nullptr ? dynamic_cast<ThreadContainer*>(threads->FindChild(own_thread_)) : nullptr;
      if (thread == nullptr) return;
      bool is_needed = false;
      root.Visit([&](const FrameworkElement& each) { is_needed = is_needed || OwnThreadId(each) == thread->id(); });
      if (is_needed) return;
      auto unlisted = runtime().Unlist(*thread);
      if (unlisted) gone = std::move(*unlisted);
    }
    runtime().Destroy(std::move(gone));
  } catch (...) {  // it stays, and runs nothing
  }
}

// What is assigned to none goes on where it is run: with one more thread nobody would have said where.
void PythonModule::KeepOthersTogether() {
  std::vector<ThreadContainer*> threads;
  runtime().root().VisitAll<ThreadContainer>([&](ThreadContainer& each) { threads.push_back(&each); });
  if (threads.empty()) threads.push_back(&CreateThread(runtime(), "main"));
  FrameworkElement* application = this;
  while (application->parent()->parent() != nullptr) application = application->parent();
  if (threads.size() == 1 && AssignedThread(*application) == 0)
    AssignThread(*application, *threads.front(), AssignedBy::kNobody);
}

void PythonModule::Update() {
  has_run_ = true;
  const GilInCycle gil;
  try {
    const auto returned = py::reinterpret_steal<py::object>(PyObject_CallNoArgs(update_.ptr()));
    if (!returned) throw py::error_already_set();
  } catch (const py::error_already_set& thrown) {
    if (!KeepInterrupt(thrown)) Fail(thrown);
  }
}

void PythonModule::Fail(const py::error_already_set& thrown) {
  const auto [summary, whole] = FaultOf(thrown);
  log().Error("{}", whole);
  throw std::runtime_error(summary);
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
  if (module->object_ && from.module->object_)
    module->WithPython([&] { Helper("take_over")(module->object_, from.module->object_); });
  return *this;
}

}  // namespace runnel::python
