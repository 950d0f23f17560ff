#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "apps/python/extension/interpreter.h"
#include "apps/python/extension/module_services.h"
#include "core/module/module.h"
#include "core/port/typed_ports.h"
#include "plugins/parameters/input_timeout.h"

namespace runnel::python {

class PythonModule;

/// What an object of Python knows of its module, which may be gone.
struct ModuleHost : std::enable_shared_from_this<ModuleHost> {
  /// Does nothing: who has made it is std::make_shared(), and pybind11 calls this for what it could not take over where
  /// memory is short, though others hold it.
  static void operator delete(void*) noexcept {}

  PythonModule* module = nullptr;
  int uses = 0;
  std::atomic<int> holds = 0;
  const int born = forks;
  /// A call of its ports or clients, in which Python may do anything but wait for an application: the module stays, and its
  /// ports stay its own, for as long.
  struct Use {
    PythonModule* module;
    Counted<int> use;
    Counted<int> by_this_thread{this_thread_place.uses};
    Counted<int> no_waiting{this_thread_place.cycles};
    PythonModule* operator->() const { return module; }
  };
  /// Throws if it is gone, or another process's. With the GIL.
  [[nodiscard]] Use Get();
  /// Its ports are about to be exchanged with another module's: when uses under way have ended. Others wait, until what is
  /// returned is let go of. Without the GIL, under the structure lock. Throws if a use does not end.
  [[nodiscard]] std::shared_ptr<void> Hold();
};

/// A module whose Update() is written in Python: a class below runnel.Module.
///
/// Threads: as Module. Takes the GIL, so it has a thread container of its own unless it is assigned to one: no cycle of
///          others on a real clock waits for the interpreter.
/// Errors:  what update() throws is a fault, with the place in the file; the whole traceback is logged.
class PythonModule final : public Module {
 public:
  /// Throws ElementError if the class cannot be had.
  PythonModule(const Placement& placement, const std::string& type);
  ~PythonModule() override;

  struct BoundInput {
    std::unique_ptr<Port> port;
    const TypedPorts* ports;
    std::unique_ptr<InputTimeout>
        timeout;  ///< nullptr: what comes there is set once, or the class has that parameter itself
  };
  [[nodiscard]] BoundInput& input(std::size_t index) { return inputs_.at(index); }
  [[nodiscard]] Port& output(std::size_t index) { return *outputs_.at(index); }
  [[nodiscard]] ModuleClient& client(std::size_t index) { return *clients_.at(index); }
  [[nodiscard]] pybind11::object ParameterValue(std::size_t index) const;
  [[nodiscard]] Time Now() const noexcept { return now(); }
  [[nodiscard]] static Duration Period() noexcept { return period(); }
  void Say(const std::string& level, const std::string& text);

 private:
  // What the object remembers: its attributes, which a module in its place takes over.
  struct Attributes {
    PythonModule* module = nullptr;
    Attributes& operator=(const Attributes& from);
    explicit Attributes(PythonModule* of) : module(of) {}
    Attributes(const Attributes&) = default;
  };

  Result<void> Construct() override;
  Result<void> Prepare() override;
  void Update() override;
  void MakeParameters(const pybind11::dict& described);
  void MakePorts(const pybind11::dict& described);
  void MakeServices(const pybind11::dict& described);
  /// Logs the traceback, and throws what the fault says.
  [[noreturn]] void Fail(const pybind11::error_already_set& thrown);
  void GoToOwnThread();
  /// The thread that was made for a module that has never run goes with it, if nobody has come to need it.
  void LeaveNoThread() noexcept;
  void KeepOthersTogether();
  /// Does it with the GIL; what Python throws becomes an ElementError, with the file and the line.
  template <typename Work>
  void WithPython(const Work& work);

  std::shared_ptr<ModuleHost> host_ = std::make_shared<ModuleHost>();
  Attributes attributes_{this};
  // Python's, touched with the GIL only.
  pybind11::handle class_;
  pybind11::handle object_;
  pybind11::handle update_;
  std::vector<std::unique_ptr<FrameworkElement>> parameters_;
  std::vector<BoundInput> inputs_;
  std::vector<std::unique_ptr<Port>> outputs_;
  std::vector<std::unique_ptr<ModuleClient>> clients_;
  std::vector<std::unique_ptr<ModuleService>> services_;
  std::string own_thread_;     // its name
  bool makes_thread_ = false;  // it was not there
  bool has_run_ = false;
};

}  // namespace runnel::python
