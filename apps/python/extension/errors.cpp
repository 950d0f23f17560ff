#include "apps/python/extension/errors.h"

#include <pybind11/eval.h>

#include "core/base/check.h"
#include "core/element/framework_element.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

py::handle error_class;  // of runnel.Error; the module has it as long as it lives

py::object PlacedError(const Error& error) {
  py::object made = error_class(error.ToString());
  made.attr("message") = error.message;
  made.attr("path") = error.path;
  made.attr("file") = error.position.file;
  made.attr("line") = error.position.line;
  made.attr("column") = error.position.column;
  made.attr("hint") = error.hint;
  return made;
}

}  // namespace

void Throw(const Diagnostics& diagnostics) {
  py::list all;
  for (const Error& each : diagnostics.errors()) all.append(PlacedError(each));
  if (all.empty()) all.append(PlacedError({.message = "this was not done"}));
  py::object thrown = all[0];
  if (all.size() > 1) {
    thrown = PlacedError(diagnostics.errors().front());
    std::string text;
    for (const Error& each : diagnostics.errors()) text += (text.empty() ? "" : "\n") + each.ToString();
    thrown.attr("args") = py::make_tuple(text);
  }
  thrown.attr("errors") = all;
  PyErr_SetObject(error_class.ptr(), thrown.ptr());
  throw py::error_already_set();
}

void Throw(const Error& error) {
  Diagnostics one;
  one.Add(error);
  Throw(one);
}

void Warn(const std::vector<Error>& warnings) {
  for (const Error& each : warnings) {
    if (PyErr_WarnEx(PyExc_UserWarning, each.ToString().c_str(), 2) != 0) throw py::error_already_set();
  }
}

void BindErrors(py::module_& module) {
  py::exec(R"(
class Error(Exception):
    """What Runnel has to say against something: a mistake, with its place and its cure.

    message -- what is wrong; path -- of the element concerned; file, line, column -- where a file says so;
    hint -- the cure, with the nearest name that there is; errors -- all that came at once, this the first.
    """
    message = path = file = hint = ""
    line = column = 0
    errors = ()
Error.__module__ = "runnel"
)",
           module.attr("__dict__"));
  error_class = module.attr("Error");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const ElementError& error) {
      try {
        Throw(error.error());
      } catch (py::error_already_set& set) {
        set.restore();
      }
    } catch (const ProgrammingError& error) {
      PyErr_SetString(error_class.ptr(), error.what());
    }
  });
}

std::pair<std::string, std::string> FaultOf(const pybind11::error_already_set& thrown) {
  const auto told = pybind11::module_::import("runnel._modules").attr("fault_of");
  // What has been thrown in C++ has no trace.
  const pybind11::object trace = thrown.trace() ? pybind11::object(thrown.trace()) : pybind11::object(pybind11::none());
  return told(thrown.value(), trace).cast<std::pair<std::string, std::string>>();
}

}  // namespace runnel::python
