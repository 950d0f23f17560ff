#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/element/runtime.h"

namespace runnel {

/// Walks through a structure whenever it has changed, for 2 ms at a time: whoever changes it waits for no longer.
/// A change during a walk begins another one; if it changes all the time, it is walked through in one go in the end.
///
/// Threads:  one at a time, all under the structure lock.
class StructureWalk {
 public:
  enum class Outcome { kUnchanged, kUnderWay, kSeen };
  /// Whether the children are to be visited, too; each element comes after its parent.
  using Visitor = std::function<bool(FrameworkElement& element)>;

  explicit StructureWalk(Runtime& runtime) : runtime_(runtime) {}

  /// `begin` is called before the first element of a walk. What they throw leaves the walk to be begun anew.
  Outcome Continue(const std::function<void()>& begin, const Visitor& visit);
  /// What the walk has seen is used from now on; without it, all is to be seen again.
  void Confirm() noexcept { seen_ = walked_; }
  /// Whether there is now what has been confirmed; elements that were found are still there then.
  [[nodiscard]] bool is_current() const { return seen_ == runtime_.revision(); }
  /// The next walk begins at once.
  void Forget() noexcept;

 private:
  Runtime& runtime_;
  std::optional<std::uint64_t> seen_;       // the runtime's revision that has been confirmed
  std::optional<std::uint64_t> walked_;     // that the last walk has come through
  std::optional<std::uint64_t> under_way_;  // in which a walk is under way
  int restarts_ = 0;
  std::vector<FrameworkElement*> ahead_;  // valid while the runtime has that revision
};

}  // namespace runnel
