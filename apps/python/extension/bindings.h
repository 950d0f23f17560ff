#pragma once

#include <pybind11/pybind11.h>

namespace runnel::python {

/// The class of applications.
void BindApplication(pybind11::module_& module);
/// Modules that are written in Python.
void BindModules(pybind11::module_& module);

/// Recordings (MCAP).
void BindRecordings(pybind11::module_& module);

}  // namespace runnel::python
