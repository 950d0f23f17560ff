#include "apps/python/extension/interpreter.h"

#include <utility>

#include "apps/python/extension/errors.h"

namespace py = pybind11;

namespace runnel::python {

void CheckMayWait() {
  if (this_thread_place.cycles == 0) return;
  Throw({.message = "an application is not waited for in update(), a service or a callback of a module, or while a value is made for a port",
         .hint = "use the module's own ports, parameters and clients, or another thread"});
}

bool KeepInterrupt(const py::error_already_set& thrown) {
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
  ++threads_without_gil;
  std::thread([end = std::move(end)]() mutable {
    end();
    end = nullptr;
    --threads_without_gil;
  }).detach();
}

void AwaitAll() {
  AwaitWithGil([] { return threads_without_gil == 0; });
}

}  // namespace runnel::python
