// What modules in Python see of themselves, and how others find their types.

#include "apps/python/extension/bindings.h"
#include "apps/python/extension/errors.h"
#include "apps/python/extension/ports.h"
#include "apps/python/extension/python_module.h"
#include "apps/python/extension/value.h"
#include "plugins/python/python_types.h"

namespace py = pybind11;

namespace runnel::python {

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

  // Each that waits in a queue counts, however old.
  py::object Give(Taking how, bool only_new, bool times_out) {
    const ModuleHost::Use module = host->Get();
    const PythonModule::BoundInput& input = module->input(index);
    return Take(*input.ports, *input.port, how, only_new, times, times_out ? input.timeout.get() : nullptr);
  }
};

template <typename Kind>
struct PartOfModule {
  std::shared_ptr<ModuleHost> host;
  std::size_t index;
};
using OutputOfModule = PartOfModule<Port>;
using ClientOfModule = PartOfModule<ModuleClient>;

template <typename Result, typename... Arguments>
auto OfClient(Result (ModuleClient::*what)(Arguments...)) {
  return
      [what](const ClientOfModule& of, Arguments... all) { return (of.host->Get()->client(of.index).*what)(all...); };
}

}  // namespace

void BindModules(py::module_& module) {
  py::class_<ModuleHost, std::shared_ptr<ModuleHost>>(module, "ModuleHost")
      .def("parameter", [](ModuleHost& host, std::size_t index) { return host.Get()->ParameterValue(index); })
      .def("input",
           [](const std::shared_ptr<ModuleHost>& host, std::size_t index) {
             return InputOfModule{host, index};
           })
      .def("output",
           [](const std::shared_ptr<ModuleHost>& host, std::size_t index) {
             return OutputOfModule{host, index};
           })
      .def("client",
           [](const std::shared_ptr<ModuleHost>& host, std::size_t index) {
             return ClientOfModule{host, index};
           })
      .def("now", [](ModuleHost& host) { return ToSeconds(host.Get()->Now()); })
      .def("period", [](const ModuleHost&) { return ToSeconds(PythonModule::Period()); })
      .def("say",
           [](ModuleHost& host, const std::string& level, const std::string& text) { host.Get()->Say(level, text); });
  py::class_<InputOfModule>(module, "ModuleInput", "An input of a module in Python, as its update() reads it.")
      .def(
          "read", [](InputOfModule& input) { return input.Give(&HeldValues::Read, false, true); },
          "The newest value; None if there is none yet, or if it is older than the input's time-out.")
      .def(
          "new", [](InputOfModule& input) { return input.Give(&HeldValues::Read, true, true); },
          "The newest value, unless it has been read or is older than the input's time-out; else None.")
      .def(
          "next", [](InputOfModule& input) { return input.Give(&HeldValues::Next, true, false); },
          "Of a connection with a queue the oldest that waits; None if none does.")
      .def_property_readonly(
          "timestamp", [](const InputOfModule& input) { return ToSeconds(input.times.timestamp); },
          "When the last value was measured (s).");
  py::class_<OutputOfModule>(module, "ModuleOutput", "An output of a module in Python.")
      .def(
          "publish",
          [](const OutputOfModule& output, const py::args& positional, const py::kwargs& named) {
            PublishFromPython(output.host->Get()->output(output.index), positional, named, std::nullopt);
          },
          "publish(value) or publish(x=1, y=2): writes the value into a buffer that the port lends, and publishes "
          "that.")
      .def(
          "publish_measured",
          [](const OutputOfModule& output, double timestamp, const py::object& value) {
            PublishFromPython(output.host->Get()->output(output.index), py::make_tuple(value), {}, timestamp);
          },
          "The same of what was measured at `timestamp` (s, of the application's clock).");
  py::class_<ClientOfModule>(module, "ModuleClient", "A client of a module in Python.")
      .def_property_readonly(
          "is_connected",
          [](const ClientOfModule& client) { return client.host->Get()->client(client.index).is_connected(); })
      .def("send", OfClient(&ModuleClient::Send), "One way: nobody is told what comes of it. Whether it is on its way.")
      .def("call", OfClient(&ModuleClient::Call),
           "callback(call) is called in a cycle of this module, when it has ended. False: it could not begin, and "
           "nobody is called back.")
      .def("begin", OfClient(&ModuleClient::Begin), "A call to be looked at later: is_done, reply, error.");
  BindModuleServices(module);
  static const ModuleTypes types{&FindModuleType};
  module.attr("module_types") = py::capsule(&types, ModuleTypes::kCapsule);
}

}  // namespace runnel::python

// The extension module runnel._extension. Its users import `runnel`, whose files are in Python.
PYBIND11_MODULE(_extension, module) {
  runnel::python::BindErrors(module);
  runnel::python::BindValues(module);
  runnel::python::BindPorts(module);
  runnel::python::BindApplication(module);
  runnel::python::BindModules(module);
  runnel::python::BindRecordings(module);
}
