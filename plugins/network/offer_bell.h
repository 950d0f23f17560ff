#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

#include "core/lockfree/taking_turns.h"
#include "core/module/after_cycle.h"
#include "core/port/waker.h"

namespace runnel {

class WakeEvent;

/// Rung by who publishes values of a port that is offered: has them sent by the network's thread, or by the thread
/// whose cycle it was in, when that has ended. Whoever sends has the turn, and who comes meanwhile leaves it to that
/// one: so no value overtakes another, whichever way they go, and nobody waits.
///
/// Why nothing is left lying: a value stands in the port, or in its queue, before the bell is rung. If the network's
/// thread is to send it, it answers the bell (acquire, of the release with which it was rung) before it asks for its
/// turn; after a cycle, the thread that has published asks itself. Who asks in vain is seen by the one that has the turn
/// (TakingTurns promises that a run of the work begins afterwards, and that it sees what has been put down before),
/// which then rings for the network's thread.
///
/// Ownership:   shared by the port and, as publishers may still hear of it (Waker, AfterCycleWork), by Retire().
/// Threads:     Wake() any; Close() outside of cycles; the rest by the network's thread.
/// Allocation:  none but of what `send` does.
class OfferBell final : public Waker, private AfterCycleWork {
 public:
  enum class By { kNetwork, kCycle };
  /// Sends what is there. By who has the turn; must not throw.
  using Send = std::function<void(By by)>;

  OfferBell(std::shared_ptr<WakeEvent> wake, Send send) : wake_(std::move(wake)), send_(std::move(send)) {}

  /// A few nanoseconds, and a call of the system if the network's thread sleeps and is to send.
  void Wake() noexcept override;
  /// That the network's thread is to look at it again.
  void Ring() noexcept;
  // relaxed: only who answers looks at what has been published.
  [[nodiscard]] bool has_rung() const noexcept { return has_rung_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool Answer() noexcept { return has_rung() && has_rung_.exchange(false, std::memory_order_acquire); }

  /// Has what is there sent, by this thread or by who is at it already.
  void SendByNetwork() noexcept { TakeTurn(By::kNetwork); }
  /// Whether values of cycles are sent after them from now on. By who has the turn.
  void set_sent_after_cycles(bool value) noexcept { is_sent_after_cycles_.store(value, std::memory_order_relaxed); }

  /// Nothing is sent any more. Waits until who is at it has sent what there was.
  void Close() noexcept;

 private:
  void RunAfterCycle() noexcept override { TakeTurn(By::kCycle); }
  void TakeTurn(By by) noexcept;

  const std::shared_ptr<WakeEvent> wake_;
  const Send send_;
  std::atomic<bool> has_rung_{false};
  // relaxed: a matter of taste for each value, as the turn keeps their order.
  std::atomic<bool> is_sent_after_cycles_{false};
  TakingTurns<> turns_;
  bool is_closed_ = false;  // by who has the turn
};

}  // namespace runnel
