#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <utility>

namespace runnel {

/// What a module's cycle and others use in turn. Others wait; the cycle only tries, and is woken by who has kept it out: once
/// he has left, not before, since a cycle that tried again at once would keep a holder of lower priority from leaving.
///
/// Threads: lock() and unlock() any; try_lock() by the cycle alone, which unlocks what it has locked.
class CycleLock {
 public:
  /// `wake` throws nothing.
  explicit CycleLock(std::function<void()> wake) : wake_(std::move(wake)) {}

  void lock() noexcept {
    // acquire: pairs with the release in unlock(), as below.
    State free = State::kFree;
    while (!state_.compare_exchange_weak(free, State::kTaken, std::memory_order_acquire)) {
      std::this_thread::yield();
      free = State::kFree;
    }
  }
  [[nodiscard]] bool try_lock() noexcept {
    State before = State::kFree;
    // Of this and the exchange in unlock() one comes second: it finds the lock free, or that the cycle has been kept out.
    while (!state_.compare_exchange_weak(before, before == State::kFree ? State::kTaken : State::kMissed,
                                         std::memory_order_acquire)) {
    }
    return before == State::kFree;
  }
  void unlock() noexcept {
    // release: what has been written under the lock is seen by who takes it.
    if (state_.exchange(State::kFree, std::memory_order_release) == State::kMissed) wake_();
  }

 private:
  enum class State { kFree, kTaken, kMissed };
  std::atomic<State> state_{State::kFree};
  const std::function<void()> wake_;
};

}  // namespace runnel
