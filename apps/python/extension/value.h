#pragma once

#include <memory>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "core/types/type_info.h"

namespace runnel::python {

/// What a Python value looks at: memory that lives as long as anybody looks at it, a lease or a value of Python's own.
/// With the GIL.
struct Memory {
  std::shared_ptr<const void> kept;
  bool is_writable = false;  ///< of Python's own
  int views = 0;             ///< arrays and elements that would dangle if a list had another size
};

/// One value, or a part of one: a structure, or a list of what NumPy has no numbers for.
struct Value {
  /// `is_element`: it lies within a list.
  Value(const TypeInfo& of, void* where, std::shared_ptr<Memory> within, bool is_element);
  ~Value();
  Value(const Value& other) : Value(*other.type, other.at, other.memory, other.counts) {}
  Value& operator=(const Value&) = delete;

  const TypeInfo* type;
  void* at;
  std::shared_ptr<Memory> memory;
  bool counts;  ///< among memory->views
};

/// What `at` is in Python: numbers, texts, truth values and names of enumerations as such; times as seconds; lists of
/// numbers as arrays that look at the memory; optional values as None or the value; else a Value.
[[nodiscard]] pybind11::object ToPython(const TypeInfo& type, void* at, const std::shared_ptr<Memory>& memory,
                                        bool is_element = false);
/// A copy that has nothing of Runnel's: dict, list, array, number, text.
[[nodiscard]] pybind11::object ToPlain(const TypeInfo& type, const void* at);
/// Sets `at` from the same, or from a text in the text format. Fields that a dict leaves out are as the type makes them, if
/// `is_whole`, else as they were. Throws TypeError, ValueError, runnel.Error with the field.
void FromPython(const TypeInfo& type, pybind11::handle object, void* at, bool is_whole = true);
/// A value of Python's own, as the type makes it. Throws if only a module can make it.
[[nodiscard]] Value NewValue(const TypeInfo& type);
[[nodiscard]] bool AreEqual(const TypeInfo& type, const void* one, const void* other);

/// The type of that name; one that is not known yet is looked for in the manifests of plugins, and its plugin loaded.
/// Throws runnel.Error with the nearest name.
[[nodiscard]] const TypeInfo& TypeNamed(const std::string& name);
/// The same; nullptr if there is none.
const TypeInfo* LookForType(const std::string& name);

/// As NumPy has it: of numbers, times (int64, ns), and of structures and lists of fixed size of them; None for others.
[[nodiscard]] pybind11::object DtypeOf(const TypeInfo& type);
/// The elements of a list or matrix as an array that looks at them; None if they do not lie in a row, or are no numbers.
[[nodiscard]] pybind11::object ArrayOf(const TypeInfo& type, void* at, const std::shared_ptr<Memory>& memory);

void BindValues(pybind11::module_& module);

}  // namespace runnel::python
