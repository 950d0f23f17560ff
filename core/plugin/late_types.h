#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/plugin/module_registry.h"

namespace runnel {

/// Says what the type called `name` is, when somebody asks for it the first time. Errors: there is none, with the
/// nearest.
using LateTypeFinder = std::function<Result<ModuleType>(std::string_view name)>;

/// Types of modules of which no plugin has a list, as they are written in another language and found when they are
/// asked for: all whose names begin with `prefix` ("python/"). Of two finders of one prefix the later is asked. Where
/// a registry has a type of the name itself, that counts.
///
/// Threads: any; locks.
void AddLateTypes(std::string prefix, LateTypeFinder find);

namespace internal {

/// The type, which stays in memory. Errors: nobody knows the prefix (an empty message); what the finder says.
[[nodiscard]] Result<const ModuleType*> FindLateType(std::string_view name);

}  // namespace internal

}  // namespace runnel
