#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/asymmetric_fence.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/patience.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

/// What lets readers pull values out of an output: its provider, and the turn that keeps the
/// publications of several threads apart.
///
/// Who has the turn may publish; who does not get it goes without, and does not wait. So at any
/// time at most one thread is the publisher, and what belongs to the publisher passes from one to
/// the next with the turn.
///
/// Threads:     any. SetProvider() waits for a provider that is running; the rest never waits.
/// Allocation:  in SetProvider() only.
template <typename T>
class PullPoint {
 public:
  using Provider = std::function<bool(T&)>;

  /// The right to publish, if it was free.
  class Turn {
   public:
    explicit Turn(PullPoint& point) noexcept : point_(point), held_(point.TryTake()) {}
    ~Turn() {
      // release: pairs with the acquire in TryTake(): what is the publisher's own is handed over.
      if (held_) point_.taken_.store(false, std::memory_order_release);
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
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
  void SetProvider(Provider provider) {
    RUNNEL_CHECK(runner_.load(std::memory_order_relaxed) != &ThisThread(),
                 "a provider cannot replace itself while it runs");
    auto next = provider ? std::make_unique<Provider>(std::move(provider)) : nullptr;
    // acq_rel: release, pairs with the acquire in Run(); acquire for who destroys the old one.
    const std::unique_ptr<Provider> before(
        provider_.exchange(next.release(), std::memory_order_acq_rel));
    if (before) WaitForRun();
  }
  /// Each of the two has the other's provider from then on, and no other is running in them.
  void ExchangeProviders(PullPoint& other) {
    // acq_rel, both: as in SetProvider(). Under the structure lock, so nobody else swaps meanwhile.
    Provider* const own = provider_.exchange(nullptr, std::memory_order_acq_rel);
    Provider* const others = other.provider_.exchange(own, std::memory_order_acq_rel);
    provider_.store(others, std::memory_order_release);
    WaitForRun();
    other.WaitForRun();
  }
  [[nodiscard]] bool has_provider() const noexcept {
    // relaxed: Run() looks again.
    return provider_.load(std::memory_order_relaxed) != nullptr;
  }

  /// Has the provider fill `value`; false if there is none, or if it has nothing. By who has the
  /// turn. Throws what the provider throws.
  [[nodiscard]] bool Run(T& value) {
    const Running running(*this);
    // acquire: pairs with the release in SetProvider().
    const Provider* const provider = provider_.load(std::memory_order_acquire);
    return provider != nullptr && (*provider)(value);
  }

  /// A pull came to nothing for want of a buffer, or by an exception.
  void CountFailure() noexcept { failures_.fetch_add(1, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t failures() const noexcept {
    // relaxed, both: a statistic.
    return failures_.load(std::memory_order_relaxed);
  }

 private:
  // While one lives, `run_` is odd.
  class Running {
   public:
    explicit Running(PullPoint& point) noexcept : point_(point) {
      point_.runner_.store(&ThisThread(), std::memory_order_relaxed);
      Step(std::memory_order_relaxed);
      // Between saying that it runs and loading the provider; pairs with WaitForRun(): if that sees
      // nobody running, the provider loaded after this fence is the new one.
      LightFence();
    }
    ~Running() {
      point_.runner_.store(nullptr, std::memory_order_relaxed);
      // release: pairs with the acquire in WaitForRun(): the provider has ended.
      Step(std::memory_order_release);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    // Written by who has the turn only: no read-modify-write is needed.
    void Step(std::memory_order order) noexcept {
      point_.run_.store(point_.run_.load(std::memory_order_relaxed) + 1, order);
    }
    PullPoint& point_;
  };

  [[nodiscard]] bool TryTake() noexcept {
    // relaxed look first: who comes while it is taken does not take the line away. acquire: pairs
    // with the release in ~Turn().
    return !taken_.load(std::memory_order_relaxed) &&
           !taken_.exchange(true, std::memory_order_acquire);
  }
  void WaitForRun() const {
    HeavyFence();
    // acquire: pairs with the release in ~Running().
    const std::uint64_t run = run_.load(std::memory_order_acquire);
    if (run % 2 == 0) return;
    for (int round = 0; run_.load(std::memory_order_acquire) == run; ++round) {
      WaitOneRound(round);
    }
  }

  alignas(kCacheLineSize) std::atomic<bool> taken_{false};
  std::atomic<std::uint64_t> run_{0};  // how often a provider has begun and ended
  std::atomic<const ThreadRecord*> runner_{nullptr};
  std::atomic<Provider*> provider_{nullptr};
  std::atomic<std::uint64_t> failures_{0};
};

}  // namespace runnel
