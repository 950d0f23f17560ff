#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/ordered_mutex.h"
#include "core/element/runtime.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

/// The trial period of new modules, and the rollback: keeps replaced modules until their successors have run
/// some cycles without throwing, and puts them back if they do throw.
///
/// Threads:  all under the editor's mutex, and not under the structure lock.
class Probation {
 public:
  Probation(Runtime& runtime, Scheduler& scheduler, Duration timeout)
      : runtime_(runtime), scheduler_(scheduler), timeout_(timeout) {}

  /// Takes those that are to be kept; the rest stays in `replaced`. Throws for lack of memory, and has taken
  /// nothing then.
  void Add(std::vector<Replaced>& replaced);
  /// Takes out all, or those whose successors have proved themselves, or are gone.
  [[nodiscard]] std::vector<UnlistedElement> Take(bool all);
  /// The module of the fault has thrown: if it is on probation, its predecessor is back when this returns.
  /// What has been done, in words; nullopt if it is not on probation. Throws if it could not be done.
  [[nodiscard]] std::optional<std::string> Answer(const Fault& fault);
  [[nodiscard]] std::size_t size() const noexcept { return waiting_.size(); }

 private:
  struct Waiting {
    Replaced replaced;
    std::uint64_t until_cycle = 0;
  };

  [[nodiscard]] FrameworkElement* Successor(const Waiting& waiting);
  [[nodiscard]] bool HasProved(const Waiting& waiting);
  Result<UnlistedElement> PutBack(Waiting& waiting);

  Runtime& runtime_;
  Scheduler& scheduler_;
  const Duration timeout_;
  std::vector<Waiting> waiting_;
  std::vector<UnlistedElement> proved_;  // that nobody has taken yet
};

}  // namespace runnel::internal
