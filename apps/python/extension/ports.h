#pragma once

#include <memory>
#include <optional>
#include <string>

#include <pybind11/pybind11.h>

#include "core/port/input_base.h"
#include "core/port/typed_ports.h"
#include "plugins/application/application.h"

namespace runnel::python {

/// An application, until it is closed: what Python has of it keeps this.
struct OpenApplication {
  std::unique_ptr<Application> application;

  OpenApplication() = default;
  OpenApplication(const OpenApplication&) = delete;
  OpenApplication& operator=(const OpenApplication&) = delete;
  /// One that nobody has closed ends here, without the GIL, for which a module may be waiting.
  ~OpenApplication();

  /// Throws if it is closed.
  Application& operator*() const;
  Application* operator->() const { return &**this; }
};

/// The value in the first place of `held`, which keeps it; None if there is none.
[[nodiscard]] pybind11::object HeldToPython(const TypeInfo& type, std::unique_ptr<HeldValues> held);

/// Has the output publish what Python says, written into a buffer that the output lends. Throws what FromPython() throws,
/// and then nothing is published.
void PublishFromPython(Port& output, const pybind11::args& positional, const pybind11::kwargs& named,
                       std::optional<double> timestamp);

/// An input, or an output, beside the application, tied to one of its ports, also after swaps. With the GIL.
class TiedPort {
 public:
  TiedPort(std::shared_ptr<OpenApplication> application, const std::string& path, PathKind kind,
           const ConnectOptions& options);
  ~TiedPort();
  TiedPort(const TiedPort&) = delete;
  TiedPort& operator=(const TiedPort&) = delete;

  /// Throws if the application is closed.
  [[nodiscard]] Port& port() const;
  [[nodiscard]] const TypedPorts& ports() const noexcept { return *ports_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  class Place;
  std::shared_ptr<OpenApplication> application_;
  std::string path_;
  const TypedPorts* ports_ = nullptr;
  Place* place_ = nullptr;
};

/// What a port publishes: the newest, or with a queue each value.
class Reader {
 public:
  Reader(std::shared_ptr<OpenApplication> application, const std::string& path, std::size_t queue);
  pybind11::object Read();
  pybind11::object Next();
  /// Waits without the GIL; false: nothing new has come. Ctrl-C ends it.
  bool Wait(double seconds);
  [[nodiscard]] std::uint64_t dropped() const;
  [[nodiscard]] double timestamp() const { return ToSeconds(times_.timestamp); }
  [[nodiscard]] double publication_time() const { return ToSeconds(times_.publication_time); }
  [[nodiscard]] const TiedPort& tied() const noexcept { return tied_; }

 private:
  pybind11::object Taken(std::unique_ptr<HeldValues> held);
  TiedPort tied_;
  ValueTimes times_;
  bool is_waited_for_ = false;
};

void BindPorts(pybind11::module_& module);

}  // namespace runnel::python
