#include "apps/python/extension/interpreter.h"

#include <cstdlib>
#include <utility>

#include "apps/python/extension/errors.h"

namespace py = pybind11;

namespace runnel::python {

void CheckMayWait() {
  if (this_thread_place.cycles <= 0) return;  // fewer: a forked child has left what it was forked in
  Throw({.message = "an application is not waited for in update(), a service or a callback of a module, or while a "
                    "value is made for a port",
         .hint = "use the module's own ports, parameters and clients, or another thread"});
}

void EndChild(py::handle error) {
  try {
    py::module_::import("runnel._modules").attr("end_child")(error);
  } catch (const std::exception&) {  // nobody is left to be told
  }
  std::_Exit(1);
}

bool KeepInterrupt(const py::error_already_set& thrown) {
  if (this_thread_place.cycles <= 0) {
    if (thrown.trace()) (void)PyException_SetTraceback(thrown.value().ptr(), thrown.trace().ptr());
    EndChild(thrown.value());
  }
  if (this_thread_place.calls == 0 || thrown.matches(PyExc_Exception)) return false;
  this_thread_place.interrupt = std::make_exception_ptr(thrown);
  return true;
}

void ThrowInterrupt() {
  if (this_thread_place.interrupt) std::rethrow_exception(std::exchange(this_thread_place.interrupt, nullptr));
}

void EndWithoutGil(std::function<void()> end) {
  if (PyGILState_Check() == 0) return end();
  if (this_thread_place.cycles + this_thread_place.calls == 0) {
    const ReleasedGil released;
    return end();
  }
  EndInThread(std::move(end));
}

void EndInThread(std::function<void()> end) {
  ++threads_without_gil;
  std::thread([end = std::move(end)]() mutable {
    end();
    end = nullptr;
    --threads_without_gil;
  }).detach();
}

ReleasedGil::~ReleasedGil() {
  const std::thread::id by = ends_in;
  const bool is_awaited = this_thread_place.cycles > 0;  // by who ends a module
  if (by == std::thread::id() || by == std::this_thread::get_id() || is_awaited) return;
  --threads_without_gil;
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

void ThrowSignal() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void AwaitAll() {
  ends_in = std::this_thread::get_id();
  AwaitWithGil([] {
    ThrowSignal();
    return threads_without_gil == 0;
  });
}

void BeginAsChild() {
  ++forks;
  threads_without_gil = 0;
  this_thread_place.cycles = this_thread_place.uses = 0;
}

}  // namespace runnel::python
