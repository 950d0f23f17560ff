#pragma once

#include <atomic>
#include <thread>
#include <utility>

#include "core/lockfree/taking_turns.h"

namespace runnel {

/// Who sends what has been published: one thread at a time, so that no value overtakes another, and nobody waits for it.
///
/// A value stands in the port, or in its queue, before its publisher either sends it by itself, or rings for the
/// network's thread, which then answers, and sends. Sending is a run of TakingTurns: who finds another thread at it leaves it to
/// that one, which then runs once more, and sees what has been put down. It does not send then, but rings: else who
/// publishes all the time could keep it there for ever.
///
/// Why nothing is left lying: each value is followed by a run that sends, or by one that rings; and what has been rung
/// for is followed by an answer, and by a run after that.
///
/// Threads:   Ring() and Send() any; Answer() by the network's thread.
/// Progress:  wait-free, but for Close().
///
/// @tparam Atomic  replaced by the search over schedules.
template <template <typename> class Atomic = std::atomic>
class SendingTurns {
 public:
  // release: pairs with the acquire of Answer(), so that who answers finds what has been published before, by this thread or,
  // where it rings in a run for another, by that one. exchange: several ring, and a store would end what began with the
  // release of another (its release sequence), whose value then might not be found.
  void Ring() noexcept { (void)has_rung_.exchange(true, std::memory_order_release); }
  // Before the run and never after it: what is rung for meanwhile is answered next time. relaxed: whether it is worth an exchange.
  [[nodiscard]] bool Answer() noexcept {
    return has_rung_.load(std::memory_order_relaxed) && has_rung_.exchange(false, std::memory_order_acquire);
  }

  /// Has `send` called, once, or leaves that to who is at it. `ring` is called if others have come meanwhile. Neither may throw.
  template <typename SendNow, typename RingBell>
  void Send(const SendNow& send, const RingBell& ring) noexcept {
    bool has_sent = false;
    turns_.Do([&]() noexcept {
      if (is_closed_) return;
      if (std::exchange(has_sent, true)) return ring();
      send();
    });
  }

  /// From now on nothing is sent. Waits until who is at it is through.
  void Close() noexcept {
    bool is_done = false;
    while (!is_done) {
      turns_.Do([&]() noexcept { is_done = is_closed_ = true; });
      std::this_thread::yield();
    }
  }

 private:
  Atomic<bool> has_rung_{false};
  TakingTurns<Atomic> turns_;
  bool is_closed_ = false;  // by whose turn it is
};

}  // namespace runnel
