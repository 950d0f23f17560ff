#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <pybind11/pybind11.h>

#include "plugins/services/services_at_run_time.h"

namespace runnel::python {

/// A service whose handler is a method of a module in Python. An exception is the call's error, and its traceback is logged.
///
/// Threads: made with the GIL, destroyed without it, as its thread may be waiting for it.
class ModuleService {
 public:
  /// `said`: what runnel._services says of it. `log_error`: into the module's log.
  ModuleService(FrameworkElement& group, const std::string& name, const pybind11::dict& said,
                std::function<void(const std::string&)> log_error);
  ~ModuleService();

  /// Before the first call.
  void SetHandler(pybind11::object handler) { handler_ = handler.release(); }

 private:
  Result<void> Serve(const CallForm& form, CallBase& call, Activity* activity);

  const std::function<void(const std::string&)> log_error_;
  pybind11::handle handler_;
  std::unique_ptr<ServiceAtRunTime> service_;
};

class ModuleClient;

/// One call, as update() looks at it; of a client that has gone, disconnected. Who keeps one that a callback got finds what came
/// of it: its slot is another call's by then. With the GIL.
class CallOfModule {
 public:
  CallOfModule(ModuleClient& client, CallBase* call, CallStatus status);
  ~CallOfModule();
  CallOfModule(const CallOfModule&) = delete;
  CallOfModule& operator=(const CallOfModule&) = delete;

  CallStatus Poll();
  [[nodiscard]] pybind11::object Reply();
  [[nodiscard]] std::string Error();
  [[nodiscard]] double Progress() const;
  [[nodiscard]] std::string Doing() const;
  void Abort();

 private:
  friend class ModuleClient;
  void Forget();
  void Leave() noexcept;

  ModuleClient* client_;
  CallBase* call_;
  CallStatus status_;
  pybind11::object reply_ = pybind11::none();  // without a call
  std::string error_;
};

/// A client of a module in Python.
///
/// Threads: made and used with the GIL, destroyed without it.
class ModuleClient {
 public:
  /// `as_fault`: what a callback has thrown, for the module's fault.
  ModuleClient(FrameworkElement& group, const std::string& name, const pybind11::dict& said,
               std::function<void(const pybind11::error_already_set&)> as_fault);
  ~ModuleClient();

  [[nodiscard]] bool is_connected() const { return client_->is_connected(); }
  /// Whether it is on its way.
  bool Send(const pybind11::args& positional, const pybind11::kwargs& named);
  bool Call(const pybind11::object& callback, const pybind11::args& positional, const pybind11::kwargs& named);
  std::unique_ptr<CallOfModule> Begin(const pybind11::args& positional, const pybind11::kwargs& named);

 private:
  friend class CallOfModule;
  [[nodiscard]] CallBase* Fill(const pybind11::args& positional, const pybind11::kwargs& named);
  void CalledBack(CallBase& call, CallStatus status);

  const std::function<void(const pybind11::error_already_set&)> as_fault_;
  std::set<CallOfModule*> looked_at_;
  std::map<CallBase*, pybind11::object> callbacks_;
  std::unique_ptr<ClientAtRunTime> client_;
};

void BindModuleServices(pybind11::module_& module);

}  // namespace runnel::python
