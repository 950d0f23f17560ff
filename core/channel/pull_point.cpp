#include "core/channel/pull_point.h"

#include <memory>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/asymmetric_fence.h"
#include "core/lockfree/backoff.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

// While one lives, `run_` is odd.
class PullPoint::Running {
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
  // Written by who has the lock only: no read-modify-write is needed.
  void Step(std::memory_order order) noexcept {
    point_.run_.store(point_.run_.load(std::memory_order_relaxed) + 1, order);
  }
  PullPoint& point_;
};

void PullPoint::SetProvider(Provider provider) {
  RUNNEL_CHECK(runner_.load(std::memory_order_relaxed) != &ThisThread(),
               "a provider cannot replace itself while it runs");
  auto next = provider ? std::make_unique<Provider>(std::move(provider)) : nullptr;
  // acq_rel: release, pairs with the acquire in Run(); acquire for who destroys the old one.
  const std::unique_ptr<Provider> before(provider_.exchange(next.release(), std::memory_order_acq_rel));
  if (before) WaitForRun();
}

void PullPoint::ExchangeProviders(PullPoint& other) {
  // acq_rel, both: as in SetProvider(). Under the structure lock, so nobody else swaps meanwhile.
  Provider* const own = provider_.exchange(nullptr, std::memory_order_acq_rel);
  Provider* const others = other.provider_.exchange(own, std::memory_order_acq_rel);
  provider_.store(others, std::memory_order_release);
  WaitForRun();
  other.WaitForRun();
}

bool PullPoint::Run(void* value, std::optional<Time>& timestamp) {
  const Running running(*this);
  // acquire: pairs with the release in SetProvider().
  const Provider* const provider = provider_.load(std::memory_order_acquire);
  return provider != nullptr && (*provider)(value, timestamp);
}

void PullPoint::WaitForRun() const {
  HeavyFence();
  // acquire: pairs with the release in ~Running().
  const std::uint64_t run = run_.load(std::memory_order_acquire);
  if (run % 2 == 0) return;
  for (int round = 0; run_.load(std::memory_order_acquire) == run; ++round) {
    BackOff(round);
  }
}

}  // namespace runnel
