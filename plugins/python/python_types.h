#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/plugin/module_registry.h"

namespace runnel::python {

/// What the extension module `runnel._extension` gives to the plugin in a capsule: how modules in Python are made. So
/// only the extension knows Python's objects, and the plugin has nothing but the interpreter.
struct ModuleTypes {
  static constexpr const char* kCapsule = "runnel._extension.module_types";
  /// "python/my_file.MyModule". Not with the GIL.
  Result<ModuleType> (*find)(std::string_view name);
};

}  // namespace runnel::python
