#include "plugins/supervision/serve_requests.h"

#include <cstdint>
#include <mutex>
#include <vector>

#include "plugins/structure/change_text.h"
#include "plugins/structure/structure_request.h"

namespace runnel::internal {

void ServeRequests(Runtime& runtime, const Supervisor::Perform& perform, const TellAnswer& tell) {
  struct Asked {
    std::uint64_t id;
    std::string path;
    std::string text;
  };
  std::vector<Asked> all;
  const auto find = [&runtime](std::uint64_t id) -> StructureRequest* {
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
    Diagnostics diagnostics;
    const PlacedChanges placed = ParseChanges(each.text, {each.path}, diagnostics);
    const auto made = diagnostics.ok() ? perform(placed.changes) : Result<ChangeSet>(diagnostics.errors().front());
    const Result<void> done = made ? Result<void>() : made.error();
    tell(each.path,
         done ? "has had it done: " + each.text : "asked in vain for: " + each.text + ": " + done.error().ToString(),
         !done);
    const std::lock_guard lock(runtime.structure_mutex());
    if (StructureRequest* const request = find(each.id)) request->Answer(done);
  }
}

}  // namespace runnel::internal
