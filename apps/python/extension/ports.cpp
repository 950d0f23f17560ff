#include "apps/python/extension/ports.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <set>
#include <utility>

#include "apps/python/extension/errors.h"
#include "apps/python/extension/value.h"
#include "core/element/file_notes.h"
#include "core/paths/path_search.h"
#include "plugins/application/run_report.h"

namespace py = pybind11;

namespace runnel::python {

using Left = std::pair<std::shared_ptr<Application>, std::vector<std::shared_ptr<ClientRecording>>>;

struct OpenApplication::End {
  Left left;
  Diagnostics problems = {};
  std::exception_ptr thrown = nullptr;
  std::atomic<bool> is_done = false;

  void Work() {
    auto& [ending, records] = left;
    try {
      for (const auto& each : std::exchange(records, {})) (void)each->Finish();
      ending->Stop();
      (void)ending->report().Finish(problems);
      for (const auto& each : ending->extensions()) (void)each->Finish(problems);
    } catch (...) {
      thrown = std::current_exception();
    }
    ending.reset();
    is_done = true;
  }
};

OpenApplication::~OpenApplication() {
  if (!application) return;
  // The end of the function is the last to have them.
  const auto mine = std::make_shared<Left>(std::move(application), std::move(recordings));
  EndWithoutGil([mine] { *mine = {}; });
}

const std::shared_ptr<Application>& OpenApplication::Get() const {
  if (is_forked) {
    Throw({.message = "the application runs in the process that this one was forked from",
           .hint = "load it here, or have multiprocessing start processes by 'spawn'"});
  }
  if (is_closed) throw py::value_error("the application is closed");
  return application;
}

void OpenApplication::Close() {
  if (is_forked) return;
  if (this_thread_place.cycles + this_thread_place.calls > 0) {
    Throw({.message = "close() would wait for the cycle or the call in which it is called",
           .hint = "call quit() in a signal handler, and close() where nothing of the application is under way"});
  }
  is_closed = is_quit = true;
  AwaitWithGil([&] {
    ThrowSignal();
    return application.use_count() <= 1;
  });
  if (application) {
    end_ = std::make_shared<End>();
    end_->left = {std::move(application), std::move(recordings)};
    EndInThread([end = end_] { end->Work(); });
  }
  AwaitWithGil([&] {
    ThrowSignal();
    return !end_ || end_->is_done;
  });
  if (!end_) return;
  if (const auto thrown = std::exchange(end_->thrown, nullptr)) std::rethrow_exception(thrown);
  Warn(std::exchange(end_->problems, {}).errors());
}

void OpenApplication::Leave() {
  is_closed = is_forked = true;
  (void)new std::pair(std::move(application), std::move(recordings));
}

void LookAround(const OpenApplication& open) {
  ThrowSignal();
  (void)open.Get();
}

py::object Take(const TypedPorts& ports, Port& input, Taking how, bool only_new, ValueTimes& times,
                InputTimeout* timeout) {
  std::shared_ptr<HeldValues> held = ports.MakeHeldValues(1);
  const bool is_new = timeout != nullptr ? timeout->Read(input, *held, 0) : (held.get()->*how)(input, 0);
  const void* const value = held->Find(0);
  if (value == nullptr || (only_new && !is_new)) return py::none();
  times = held->times(0);
  return ToPython(input.type(), ForLooking(value), std::make_shared<Memory>(Memory{.kept = std::move(held)}));
}

void PublishFromPython(Port& output, const py::args& positional, const py::kwargs& named,
                       std::optional<double> timestamp) {
  // Python may run another thread while the buffer is filled.
  static auto* const busy = new std::set<const Port*>;
  if (!busy->insert(&output).second) throw py::value_error("another thread publishes there already");
  struct Done {
    const Port* port;
    ~Done() { busy->erase(port); }
  } const done{&output};
  std::exception_ptr thrown;
  const auto fill = [&](void* value) -> Result<void> {
    try {
      if (positional.size() > 1 || positional.empty() == named.empty()) {
        throw py::type_error("publish() takes one value, or fields by their names");
      }
      FromPython(output.type(), positional.empty() ? py::handle(named) : py::handle(positional[0]), value);
      return {};
    } catch (...) {
      thrown = std::current_exception();
      return Error{.message = "thrown"};
    }
  };
  std::optional<Time> measured;
  if (timestamp && !std::isfinite(*timestamp)) throw py::value_error("a timestamp is a number of seconds");
  if (timestamp) measured = Time(FromSeconds(*timestamp));
  const auto published = output.PublishFilled(fill, measured);
  if (thrown) std::rethrow_exception(thrown);
  if (Checked(published) == PublishStatus::kNoBuffer) {
    Throw({.message = "its pool of buffers has none that is free", .path = output.path()});
  }
}

/// What holds the port, beside the application. Nobody else deletes it.
class TiedPort::Place final : public FrameworkElement {
 public:
  explicit Place(const Placement& placement) : FrameworkElement(placement) { Annotate(std::make_unique<NotSaved>()); }
  std::unique_ptr<Port> port;
};

TiedPort::TiedPort(Open open, const std::string& path, PathKind kind, const ConnectOptions& options)
    : open_(std::move(open)) {
  const Use use(*open_);
  Runtime& runtime = use->runtime();
  const auto tie = [&]() -> Result<void> {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto found = PathSearch(runtime).FindPort(path, kind);
    if (!found) return found.error();
    Port& port = **found;
    path_ = port.path();
    ports_ = FindTypedPorts(port.type());
    if (ports_ == nullptr) return Error{.message = "nobody makes ports of type " + port.type().name(), .path = path_};
    place_ = &runtime.Create<Place>(runtime.root(), FreeName(runtime.root(), "python"));
    const bool reads = kind == PathKind::kOutput;
    place_->port = reads ? ports_->MakeInput(*place_, "in", {.waits = true}) : ports_->MakeOutput(*place_, "out");
    if (!place_->port)
      return Error{.message = "only a module can make values of type " + port.type().name(), .path = path_};
    if (auto ready = runtime.MakeReady(*place_); !ready) return ready;
    return reads ? Port::Connect(port, *place_->port, options) : Port::Connect(*place_->port, port, options);
  };
  const auto tied = WithoutGil(open_, [&](Application&) {
    auto done = tie();
    if (!done && place_ != nullptr) (void)runtime.Delete(*std::exchange(place_, nullptr));
    return done;
  });
  Checked(tied);
}

TiedPort::~TiedPort() {
  if (place_ == nullptr || open_->is_closed) return;
  EndWithoutGil([place = place_, application = open_->application] { (void)application->runtime().Delete(*place); });
}

Port& TiedPort::port(const Use& /*use*/) const { return *place_->port; }

Reader::Reader(Open open, const std::string& path, std::size_t queue)
    : tied_(std::move(open), path, PathKind::kOutput, {.queue = queue}) {}

bool Reader::Wait(double seconds) {
  constexpr double kSlice = 0.1;  // after which signals are looked at
  const Use use(*tied_.open());
  auto& input = dynamic_cast<InputBase&>(tied_.port(use));
  if (std::exchange(is_waited_for_, true)) throw py::value_error("another thread waits already");
  const std::shared_ptr<void> done(nullptr, [this](void*) { is_waited_for_ = false; });
  for (double left = seconds;; left -= kSlice) {
    const double slice = std::clamp(left, 0.0, kSlice);
    if (WithoutGil(tied_.open(), [&](Application&) { return input.Wait(FromSeconds(slice)); })) return true;
    LookAround(*tied_.open());
    if (left <= kSlice) return false;
  }
}

std::uint64_t Reader::dropped() const { return dynamic_cast<InputBase&>(tied_.port(Use(*tied_.open()))).dropped(); }

bool Reader::IsAt(const std::string& path) {
  const std::uint64_t names = tied_.open()->names->count();
  if (names_ == names) return true;
  const bool may_wait = this_thread_place.cycles <= 0;
  const Use use(*tied_.open());
  const auto look = [&] {
    std::unique_lock lock(use->runtime().structure_mutex(), std::defer_lock);
    if (may_wait) lock.lock();
    if (!may_wait && !lock.try_lock()) return true;
    const auto found = PathSearch(use->runtime()).FindPort(path, PathKind::kOutput);
    const bool is_there = found && std::ranges::count(tied_.port(use).incoming(), *found) > 0;
    if (is_there) names_ = names;
    return is_there;
  };
  return may_wait ? WithoutGil(look) : look();
}

void BindPorts(py::module_& module) {
  py::class_<Reader, std::shared_ptr<Reader>>(module, "Reader",
                                              R"(Reads a port of an application in this process, also after swaps.

One thread at a time uses it. A value that has been read is leased, not copied: its buffer is not used again as long as
the value, or an array of it, lives.
)")
      .def("read", &Reader::Read, "The newest value; None if there is none yet.")
      .def("next", &Reader::Next,
           "The next value that has not been given out: of a queue the oldest, else the newest. None if there is none.")
      .def("wait", &Reader::Wait, py::arg("timeout") = 1.0,
           "Waits until there is something new; False if there is not after `timeout` (s, of the machine).")
      .def("_is_at", &Reader::IsAt)
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__",
           [](Reader& reader) {
             py::object next = reader.Next();
             if (next.is_none()) throw py::stop_iteration();
             return next;
           })
      .def_property_readonly("path", [](const Reader& reader) { return reader.tied().path(); })
      .def_property_readonly("type", [](const Reader& reader) { return reader.tied().type(); })
      .def_property_readonly("timestamp", &Reader::timestamp,
                             "When the last value was measured (s, of the application's clock).")
      .def_property_readonly("publication_time", &Reader::publication_time, "When it was published (s).")
      .def_property_readonly("dropped", &Reader::dropped, "Values that the queue has lost because it was full.");
  py::class_<TiedPort, std::shared_ptr<TiedPort>>(
      module, "Writer", R"(Publishes to an input of an application in this process, also after swaps.

One thread at a time uses it, outside of cycles.
)")
      .def(
          "publish",
          [](const TiedPort& tied, const py::args& positional, const py::kwargs& named) {
            const Use use(*tied.open());
            PublishFromPython(tied.port(use), positional, named, std::nullopt);
          },
          "publish(value) or publish(x=1, y=2): writes the value into a buffer that the port lends, and publishes "
          "that.")
      .def_property_readonly("path", &TiedPort::path)
      .def_property_readonly("type", &TiedPort::type);
}

}  // namespace runnel::python
