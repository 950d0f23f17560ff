#include "plugins/runtime_construction/port_types.h"

#include <thread>

#include "core/element/runtime.h"

namespace runnel {

void MakePortTypesKnown(const ModuleRegistry& modules) {
  std::thread([&modules] {
    Runtime scratch;
    for (const ModuleType* type : modules.All()) {
      // One that cannot be made here brings no type; if the application asks for it, that is told.
      (void)modules.Create(type->name, scratch.root(),
                           std::to_string(scratch.root().children().size()));
    }
  }).join();
}

}  // namespace runnel
