#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <list>
#include <memory>
#include <mutex>

#include "core/base/clock.h"

namespace runnel {

/// Whether a stop is in force, and when it was last released: one number, which readers compare with the two times
/// of a value. A value counts if both are later than the bar.
///
///     never in force    lowest       every value counts
///     in force          highest      none does
///     released at t     t            those from after t
///
/// Threads:     any. bar() and in_force() are wait-free; Press() is in force before it takes the mutex, by which
///              listeners are called one after the other.
/// Allocation:  in Listen().
class StopSignal : public std::enable_shared_from_this<StopSignal> {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();
  static constexpr std::int64_t kInForce = std::numeric_limits<std::int64_t>::max();
  using Listener = std::function<void()>;

  /// As long as it lives the listener is called; when its destructor returns it is not running any more.
  class Subscription {
   public:
    Subscription() = default;
    Subscription(Subscription&&) noexcept = default;
    Subscription& operator=(Subscription&& other) noexcept;
    ~Subscription() { End(); }

   private:
    friend class StopSignal;
    void End() noexcept;
    std::shared_ptr<StopSignal> signal_;
    std::list<Listener>::iterator place_;
  };

  /// False: it was in force already. `note` is called when it is in force, before listeners are.
  bool Press(const Listener& note = {});
  /// `now`: the time by which values are stamped, at the release. False: it was not in force.
  bool Release(const std::function<Time()>& now, const Listener& note = {});

  /// As if it had been pressed and released at that moment: what was published by then does not count any more.
  /// Nothing while it is in force.
  void Bar(const std::function<Time()>& at);

  /// acquire: what the one who pressed or released did before is seen.
  [[nodiscard]] std::int64_t bar() const noexcept { return bar_.load(std::memory_order_acquire); }
  [[nodiscard]] bool in_force() const noexcept { return bar() == kInForce; }

  /// Has `listener` called after each change, by who makes it. It looks at the state itself: of two changes in quick
  /// succession it may see the later one twice. It must not press, release, listen, or take the structure lock.
  /// What it throws, for lack of memory, keeps it from nobody else.
  [[nodiscard]] Subscription Listen(Listener listener);

 private:
  void Tell(const Listener& note);

  std::atomic<std::int64_t> bar_{kNever};
  std::mutex releasers_;  // of two, the later one reads the later time
  std::mutex mutex_;
  std::list<Listener> listeners_;  // guarded by mutex_
};

}  // namespace runnel
