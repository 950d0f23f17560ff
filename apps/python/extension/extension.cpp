// The extension module runnel._extension. Its users import `runnel`, whose files are in Python.

#include <pybind11/pybind11.h>

#include "apps/python/extension/bindings.h"
#include "apps/python/extension/errors.h"
#include "apps/python/extension/ports.h"
#include "apps/python/extension/value.h"

PYBIND11_MODULE(_extension, module) {
  runnel::python::BindErrors(module);
  runnel::python::BindValues(module);
  runnel::python::BindPorts(module);
  runnel::python::BindApplication(module);
  runnel::python::BindModules(module);
  runnel::python::BindRecordings(module);
}
