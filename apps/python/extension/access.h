#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "apps/python/extension/ports.h"

namespace runnel::python {

// What is looked at and said in an application. With the GIL, which they let go of while they wait.

/// The value of a parameter.
[[nodiscard]] pybind11::object Get(const Open& open, const std::string& path);
/// A Reader of an output. Of an input what it reads, as a copy: nothing else shows it.
[[nodiscard]] pybind11::object ReadInput(const Open& open, const std::string& path);
void PublishByHand(const Open& open, const std::string& path, const pybind11::object& value);
/// The reply of a service. Runs cycles meanwhile, if nobody does and time is simulated.
[[nodiscard]] pybind11::object Call(const Open& open, const std::string& path, double timeout,
                                    const pybind11::args& positional, const pybind11::kwargs& named);
/// (path, kind, type) of each element.
[[nodiscard]] pybind11::list Paths(const Open& open);
/// (time, kind, module, text) from entry number `from` on.
[[nodiscard]] pybind11::list Log(const Open& open, std::uint64_t from);
/// (kind, path, message, text) since the last call.
[[nodiscard]] pybind11::list Events(const Open& open);
/// So many cycles of simulated time.
void Step(const Open& open, std::uint64_t cycles);

}  // namespace runnel::python
