// What modules ask for (StructureRequest), in the order in which they asked. A request may delete who has asked.

#include <cstdint>
#include <mutex>
#include <vector>

#include "core/element/attempt.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/structure_request.h"
#include "plugins/supervision/supervisor_shared.h"

namespace runnel {

// Outside of cycles and without locks.
void Supervisor::Shared::ServeRequests(Time now) {
  struct Asked {
    std::uint64_t id;
    std::string path;
    std::string text;
  };
  std::vector<Asked> all;
  const auto find = [this](std::uint64_t id) -> StructureRequest* {
    for (StructureRequest* each : StructureRequests::Of(runtime)->all()) {
      if (each->element().id() == id && each->is_asked()) return each;
    }
    return nullptr;
  };
  {
    const std::lock_guard lock(runtime.structure_mutex());
    const StructureRequests* const requests = StructureRequests::Of(runtime);
    if (requests == nullptr) return;
    for (const StructureRequest* each : requests->all()) {
      // Beside the tree nobody runs, and asks for nothing.
      if (!each->is_asked() || each->element().life_cycle() != LifeCycle::kReady) continue;
      all.push_back({each->element().id(), each->element().path(), std::string(each->text())});
    }
  }
  for (const Asked& each : all) {
    const auto done = Attempt([&] {
      Diagnostics diagnostics;
      const PlacedChanges placed = ParseChanges(each.text, {each.path}, diagnostics);
      return diagnostics.ok() ? perform(placed.changes) : Result<ChangeSet>(diagnostics.errors().front());
    });
    {
      const std::lock_guard lock(runtime.structure_mutex());
      if (StructureRequest* const request = find(each.id)) request->Answer(done ? Result<void>() : done.error());
    }
    // It has been answered, whether there is memory to tell of it or not.
    EachForItself().Do([&] {
      Note({each.path,
            done ? "has had it done: " + each.text : "asked in vain for: " + each.text + ": " + done.error().ToString(),
            now, !done});
    });
  }
}

}  // namespace runnel
