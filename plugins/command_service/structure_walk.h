#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
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
  void Forget() noexcept {
    seen_.reset();
    under_way_.reset();
  }

 private:
  static constexpr auto kHold = std::chrono::milliseconds(2);
  static constexpr int kMostRestarts = 20;
  static constexpr std::size_t kStride = 64;  // elements between two looks at the clock

  Runtime& runtime_;
  std::optional<std::uint64_t> seen_;       // the runtime's revision that has been confirmed
  std::optional<std::uint64_t> walked_;     // that the last walk has come through
  std::optional<std::uint64_t> under_way_;  // in which a walk is under way
  int restarts_ = 0;
  std::vector<FrameworkElement*> ahead_;  // valid while the runtime has that revision
};

inline StructureWalk::Outcome StructureWalk::Continue(const std::function<void()>& begin, const Visitor& visit) {
  if (is_current()) return Outcome::kUnchanged;
  const auto until = std::chrono::steady_clock::now() + kHold;
  const std::uint64_t revision = runtime_.revision();
  const auto before = std::exchange(under_way_, std::nullopt);
  if (before != revision) {
    restarts_ = before ? restarts_ + 1 : 0;
    ahead_ = {&runtime_.root()};
    begin();
  }
  for (std::size_t i = 1; !ahead_.empty(); ++i) {
    FrameworkElement& element = *ahead_.back();
    ahead_.pop_back();
    const auto& children = element.children();
    if (visit(element)) ahead_.insert(ahead_.end(), children.rbegin(), children.rend());
    const bool is_late = i % kStride == 0 && std::chrono::steady_clock::now() >= until;
    if (!is_late || restarts_ > kMostRestarts || ahead_.empty()) continue;
    under_way_ = revision;
    return Outcome::kUnderWay;
  }
  restarts_ = 0;
  walked_ = revision;
  return Outcome::kSeen;
}

}  // namespace runnel
