// Modules in Python for whichever process: starts the interpreter where there is none, and asks the package `runnel`.

#include <filesystem>
#include <mutex>
#include <string>

#include <Python.h>
#include <dlfcn.h>

#include "core/element/attempt.h"
#include "core/element/framework_element.h"
#include "core/plugin/module_registry.h"
#include "core/plugin/plugin_entry.h"
#include "plugins/python/python_types.h"

namespace runnel::python {

namespace {

// What this library was linked with is private to it; NumPy and others look for Python's functions among what is global.
void MakePythonGlobal() {
  Dl_info found{};
  if (dladdr(reinterpret_cast<const void*>(&Py_IsInitialized), &found) != 0) {
    (void)dlopen(found.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
  }
}

// Where the package is, seen from this library's file: beside lib of the build tree or of the installation.
std::string PackageFolders() {
  Dl_info found{};
  (void)dladdr(reinterpret_cast<const void*>(&PackageFolders), &found);
  std::string folders;
  for (auto at = std::filesystem::path(found.dli_fname == nullptr ? "" : found.dli_fname).parent_path();
       at.has_relative_path(); at = at.parent_path()) {
    const auto folder = at / "python3" / "dist-packages";
    std::error_code none;
    if (std::filesystem::exists(folder / "runnel" / "__init__.py", none)) folders += folder.string() + "\n";
  }
  return folders;
}

std::string PythonErrorText() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyObject* const text = value != nullptr ? PyObject_Str(value) : nullptr;
  const char* const words = text != nullptr ? PyUnicode_AsUTF8(text) : nullptr;
  std::string said = words != nullptr ? words : "no reason is known";
  Py_XDECREF(text);
  Py_XDECREF(type);
  Py_XDECREF(value);
  Py_XDECREF(trace);
  return said;
}

// With the GIL. Throws if the package is not there.
const ModuleTypes& Import() {
  PyObject* const folders = PyUnicode_FromString(PackageFolders().c_str());
  PyObject* const lines = folders != nullptr ? PyUnicode_Splitlines(folders, 0) : nullptr;
  PyObject* const path = PySys_GetObject("path");
  for (Py_ssize_t i = 0; lines != nullptr && i < PyList_Size(lines); ++i) {
    PyObject* const folder = PyList_GetItem(lines, i);
    if (PySequence_Contains(path, folder) == 0) PyList_Append(path, folder);
  }
  Py_XDECREF(lines);
  Py_XDECREF(folders);
  PyObject* const package = PyImport_ImportModule("runnel");
  const void* const types = package != nullptr ? PyCapsule_Import(ModuleTypes::kCapsule, 0) : nullptr;
  if (types == nullptr) {
    throw ElementError({.message = "modules in Python need the package 'runnel': " + PythonErrorText(),
                        .hint = "install python3-runnel, or set PYTHONPATH"});
  }
  return *static_cast<const ModuleTypes*>(types);
}

const ModuleTypes& Start() {
  if (Py_IsInitialized() == 0) {
    MakePythonGlobal();
    Py_InitializeEx(0);  // signals are the program's
    // What modules print is to be seen at once: the interpreter is never brought to an end.
    (void)PyRun_SimpleString("import sys\nsys.stdout.reconfigure(line_buffering=True)\nsys.argv = ['runnel']\n");
    (void)PyEval_SaveThread();
  }
  const PyGILState_STATE state = PyGILState_Ensure();
  struct Release {
    PyGILState_STATE state;
    ~Release() { PyGILState_Release(state); }
  } const release{state};
  return Import();
}

// Once somebody asks for a type: whoever only lists plugins needs no interpreter.
runnel::Result<ModuleType> Find(std::string_view name) {
  static std::mutex mutex;
  static const ModuleTypes* types = nullptr;
  return runnel::Attempt([&]() -> runnel::Result<ModuleType> {
    {
      const std::lock_guard lock(mutex);
      if (types == nullptr) types = &Start();
    }
    return types->find(name);
  });
}

}  // namespace

}  // namespace runnel::python

RUNNEL_PLUGIN(python, registry) { runnel::AddLateTypes("python/", runnel::python::Find); }
