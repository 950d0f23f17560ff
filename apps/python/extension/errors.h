#pragma once

#include <pybind11/pybind11.h>

#include "core/base/error.h"
#include "core/base/result.h"
#include "plugins/structure/structure_editor.h"

namespace runnel::python {

/// What Runnel's errors are in Python: runnel.Error, with `errors`, a list of those that came at once, and of the
/// first `message`, `path`, `file`, `line`, `column` and `hint`. With the GIL.
[[noreturn]] void Throw(const Diagnostics& diagnostics);
[[noreturn]] void Throw(const Error& error);

void Warn(const std::vector<Error>& warnings);

template <typename T>
T Checked(Result<T> result) {
  if (!result) Throw(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}
inline void Check(const ChangeOutcome& outcome) {
  if (!outcome) Throw(outcome.diagnostics);
}

/// The class, and what C++ throws.
void BindErrors(pybind11::module_& module);

/// What a fault says of what Python has thrown, and the whole traceback. With the GIL.
[[nodiscard]] std::pair<std::string, std::string> FaultOf(const pybind11::error_already_set& thrown);

}  // namespace runnel::python
