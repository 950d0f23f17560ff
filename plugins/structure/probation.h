#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/ordered_mutex.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

/// The trial period of new modules, and the rollback: keeps replaced modules until their successors have run
/// some cycles without throwing, and puts them back if they do throw.
///
/// Threads:  all under the editor's mutex, but for PutBack(), which may take long; not under the structure lock.
class Probation {
 public:
  Probation(Runtime& runtime, Scheduler& scheduler, Duration timeout)
      : runtime_(runtime), scheduler_(scheduler), timeout_(timeout) {}

  /// Takes those that are to be kept; the rest stays in `replaced`, with a warning where that ends a probation. Throws for lack of
  /// memory, and has taken nothing then.
  void Add(std::vector<Replaced>& replaced, Diagnostics& diagnostics);
  /// Takes out all, or those whose successors have proved themselves, or are gone.
  [[nodiscard]] std::vector<UnlistedElement> Take(bool all);
  /// Whether the module of the fault, which has thrown, is on probation.
  [[nodiscard]] bool Concerns(const Fault& fault);
  /// The predecessor of that module is back when this returns. What has been done, in words. Throws if it could not be.
  [[nodiscard]] std::string PutBack(const Fault& fault, OrderedMutex& mutex);
  [[nodiscard]] std::size_t size() const noexcept { return waiting_.size(); }

 private:
  struct Waiting {
    Replaced replaced;
    std::uint64_t until_cycle = 0;  // 0: it has proved itself
  };

  [[nodiscard]] FrameworkElement* Successor(const Waiting& waiting);
  [[nodiscard]] bool HasProved(const Waiting& waiting);
  [[nodiscard]] std::vector<Waiting>::iterator Find(const std::string& path);
  Result<UnlistedElement> PutBack(Waiting& waiting, std::string& done);

  Runtime& runtime_;
  Scheduler& scheduler_;
  const Duration timeout_;
  std::vector<Waiting> waiting_;
  std::vector<UnlistedElement> proved_;  // that nobody has taken yet
};

}  // namespace runnel::internal
