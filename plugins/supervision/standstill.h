#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/port/port.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::internal {

/// Has ports that drive read their safe value while a module that feeds them does not run: it is paused, has failed, or its
/// thread is stuck. By the slot of rules, and until the module has published again. Tells where the module that drives does
/// not run itself, so that neither this nor a STOP reaches it.
///
/// Threads: all under the structure lock.
class Standstill {
 public:
  using Tell = std::function<void(const Port& port, std::string what, bool is_recovery)>;

  /// Costs little while the structure stays as it is.
  void Look(Runtime& runtime, const Scheduler& scheduler, Time now, const Tell& tell);
  /// A rule has set the port's value; it is the rule's to take it back.
  static void LeaveToRule(Port& port);

 private:
  struct Driven {
    Port* port;
    std::vector<Port*> sources;
    std::vector<Port*> sinks;
  };
  static void LookAtReaders(const Driven& driven, const Scheduler& scheduler, const Tell& tell);
  static void LookAtSources(const Driven& driven, const Scheduler& scheduler, Time now, const Tell& tell);

  std::vector<Driven> driven_;  // as of the structure's revision
  std::uint64_t revision_ = ~std::uint64_t{};
};

}  // namespace runnel::internal
