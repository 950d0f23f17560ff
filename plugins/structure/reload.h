#pragma once

#include <string_view>

#include "core/plugin/plugin_manager.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {

/// Loads the library of a plugin as it is now on disk, and makes all modules of its types anew by it,
/// between two cycles: the running application goes on with the new code. The old code stays in memory for
/// what is left of it: values that are still held, data types.
///
/// Everything is as before if the library is refused (built for another core, registration fails), if a type
/// that is in use is missing, if a module cannot be made, or if data types have another layout than those
/// that the rest of the application knows.
///
/// Threads:  as StructureEditor::Apply(), as is `as_of`; one at a time.
ChangeOutcome ReloadPlugin(PluginManager& plugins, StructureEditor& editor, Runtime& runtime, std::string_view plugin,
                           const RobotStop::AsOf& as_of = {});

}  // namespace runnel
