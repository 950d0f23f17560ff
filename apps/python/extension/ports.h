#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <pybind11/pybind11.h>

#include "apps/python/extension/interpreter.h"
#include "core/element/runtime.h"
#include "core/port/input_base.h"
#include "core/port/typed_ports.h"
#include "plugins/application/application.h"
#include "plugins/command_service/command_service.h"
#include "plugins/parameters/input_timeout.h"

namespace runnel::python {

/// Counts what may give a path another meaning. Threads: any.
class NameChanges final : public ElementListener {
 public:
  void OnReady(FrameworkElement& /*element*/) override { ++count_; }
  void OnDeleted(FrameworkElement& /*element*/) override { ++count_; }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

 private:
  std::atomic<std::uint64_t> count_ = 0;
};

/// An application, until it is closed: what Python has of it keeps this.
///
/// Threads: with the GIL, but for what is atomic.
struct OpenApplication {
  std::shared_ptr<Application> application;
  const std::shared_ptr<NameChanges> names = std::make_shared<NameChanges>();
  std::vector<std::shared_ptr<ClientRecording>> recordings = {};  ///< that have begun and have not ended
  std::thread::id runs_in = {};                                   ///< whose call runs cycles; one at a time
  std::atomic<bool> is_quit = false;                              ///< that call is to end
  std::atomic<bool> is_closed = false;
  std::atomic<bool> is_forked = false;  ///< the process that has opened it is another one

  /// One that nobody has closed ends here, or soon after.
  ~OpenApplication();

  /// Throws if it is closed.
  [[nodiscard]] const std::shared_ptr<Application>& Get() const;
  /// Waits for calls under way, which find it closed, and until it has ended; a signal ends the wait alone. Throws within one
  /// of them, and within a cycle.
  void Close();
  /// In a forked child, which has none of the threads: nothing of it ends.
  void Leave();

 private:
  struct End;
  std::shared_ptr<End> end_;
};
using Open = std::shared_ptr<OpenApplication>;

/// A call under way: the application stays for as long. With the GIL. Throws if it is closed.
class Use {
 public:
  explicit Use(const OpenApplication& open) : application_(open.Get()) {}
  Application& operator*() const { return *application_; }
  Application* operator->() const { return application_.get(); }

 private:
  const std::shared_ptr<Application> application_;
  Counted<int> call_{this_thread_place.calls};
};

/// Does it with the application, and without the GIL. Throws where it may not be waited for.
template <typename Work>
auto WithoutGil(const Open& open, const Work& work) {
  CheckMayWait();
  const Use use(*open);
  return WithoutGil([&] { return work(*use); });
}

/// Between two waits of a call: throws what a signal has, and that the application has been closed.
void LookAround(const OpenApplication& open);

/// What the input gives out by `how`, and its times; None if there is none, or with `only_new` none that is new. With a
/// `timeout` the newest one, if that counts.
using Taking = bool (HeldValues::*)(Port&, std::size_t) noexcept;
[[nodiscard]] pybind11::object Take(const TypedPorts& ports, Port& input, Taking how, bool only_new, ValueTimes& times,
                                    InputTimeout* timeout = nullptr);

/// Has the output publish what Python says, written into a buffer that the output lends. Throws what FromPython() throws,
/// and then nothing is published.
void PublishFromPython(Port& output, const pybind11::args& positional, const pybind11::kwargs& named,
                       std::optional<double> timestamp);

/// An input, or an output, beside the application, tied to one of its ports, also after swaps. With the GIL.
class TiedPort {
 public:
  TiedPort(Open open, const std::string& path, PathKind kind, const ConnectOptions& options);
  ~TiedPort();
  TiedPort(const TiedPort&) = delete;
  TiedPort& operator=(const TiedPort&) = delete;

  [[nodiscard]] const Open& open() const noexcept { return open_; }
  /// While `use` keeps the application.
  [[nodiscard]] Port& port(const Use& use) const;
  [[nodiscard]] std::string type() const { return port(Use(*open_)).type().name(); }
  [[nodiscard]] const TypedPorts& ports() const noexcept { return *ports_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  class Place;
  Open open_;
  std::string path_;
  const TypedPorts* ports_ = nullptr;
  Place* place_ = nullptr;
};

/// What a port publishes: the newest, or with a queue each value.
class Reader {
 public:
  Reader(Open open, const std::string& path, std::size_t queue);
  pybind11::object Read() {
    return Take(tied_.ports(), tied_.port(Use(*tied_.open())), &HeldValues::Read, false, times_);
  }
  pybind11::object Next() {
    return Take(tied_.ports(), tied_.port(Use(*tied_.open())), &HeldValues::Next, true, times_);
  }
  /// Waits without the GIL; false: nothing new has come. Ctrl-C ends it.
  bool Wait(double seconds);
  [[nodiscard]] std::uint64_t dropped() const;
  /// Whether the path means what this reads. In a cycle, for which changes wait, as it was before them.
  [[nodiscard]] bool IsAt(const std::string& path);
  [[nodiscard]] double timestamp() const { return ToSeconds(times_.timestamp); }
  [[nodiscard]] double publication_time() const { return ToSeconds(times_.publication_time); }
  [[nodiscard]] const TiedPort& tied() const noexcept { return tied_; }

 private:
  TiedPort tied_;
  ValueTimes times_;
  bool is_waited_for_ = false;
  std::atomic<std::uint64_t> names_ = 0;  // how many changes of names there had been when it was there
};

void BindPorts(pybind11::module_& module);

}  // namespace runnel::python
