#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/base/clock.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/thread_record.h"

namespace runnel {

/// What lets readers pull values out of an output: its provider, and the lock that keeps the
/// publications of several threads apart.
///
/// Who has the lock may publish; who does not get it goes without, and does not wait. So at any
/// time at most one thread is the publisher, and what belongs to the publisher passes from one to
/// the next with the lock.
///
/// Threads:     any. SetProvider() waits for a provider that is running; the rest never waits.
/// Allocation:  in SetProvider() only.
class PullPoint {
 public:
  /// Fills a value of the output's type, and says when it was measured, if it knows.
  using Provider = std::function<bool(void* value, std::optional<Time>& timestamp)>;

  /// The right to publish, if it was free.
  class Lock {
   public:
    explicit Lock(PullPoint& point) noexcept : point_(point), held_(point.TryTake()) {}
    ~Lock() {
      // release: pairs with the acquire in TryTake(): what is the publisher's own is handed over.
      if (held_) point_.taken_.store(false, std::memory_order_release);
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    [[nodiscard]] bool held() const noexcept { return held_; }

   private:
    PullPoint& point_;
    const bool held_;
  };

  PullPoint() = default;
  ~PullPoint() { delete provider_.load(std::memory_order_relaxed); }
  PullPoint(const PullPoint&) = delete;
  PullPoint& operator=(const PullPoint&) = delete;

  /// Swaps the provider; none if empty. When it returns, the one before is not running any more.
  /// Errors: throws ProgrammingError when called by the provider itself, which would wait for ever.
  void SetProvider(Provider provider);
  /// Each of the two has the other's provider from then on, and no other is running in them.
  void ExchangeProviders(PullPoint& other);
  [[nodiscard]] bool has_provider() const noexcept {
    // relaxed: Run() looks again.
    return provider_.load(std::memory_order_relaxed) != nullptr;
  }

  /// Has the provider fill `value`; false if there is none, or if it has nothing. By who has the
  /// lock. Throws what the provider throws.
  [[nodiscard]] bool Run(void* value, std::optional<Time>& timestamp);

  /// A pull came to nothing for want of a buffer, or by an exception.
  void CountFailure() noexcept { failures_.fetch_add(1, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t failures() const noexcept {
    // relaxed, both: a statistic.
    return failures_.load(std::memory_order_relaxed);
  }

 private:
  class Running;

  [[nodiscard]] bool TryTake() noexcept {
    // relaxed look first: who comes while it is taken does not take the line away. acquire: pairs
    // with the release in ~Lock().
    return !taken_.load(std::memory_order_relaxed) && !taken_.exchange(true, std::memory_order_acquire);
  }
  void WaitForRun() const;

  alignas(kCacheLineSize) std::atomic<bool> taken_{false};
  std::atomic<std::uint64_t> run_{0};  // how often a provider has begun and ended
  std::atomic<const ThreadRecord*> runner_{nullptr};
  std::atomic<Provider*> provider_{nullptr};
  std::atomic<std::uint64_t> failures_{0};
};

}  // namespace runnel
