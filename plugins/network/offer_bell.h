#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

#include "core/channel/waker.h"
#include "core/lockfree/wake_event.h"
#include "core/module/after_cycle.h"
#include "plugins/network/sending_turns.h"

namespace runnel {

/// Rung by who publishes values of a port that is offered: has them sent by the network's thread, or by the thread
/// whose cycle it was in, when that has ended. Both send in turn (SendingTurns).
///
/// Ownership:   shared by the port and, as publishers may still hear of it (Waker, AfterCycleWork), by Retire().
/// Threads:     Wake() any; Close() outside of cycles; the rest by the network's thread.
/// Allocation:  none but of what `send` does.
class OfferBell final : public Waker, private AfterCycleWork {
 public:
  enum class By { kNetwork, kCycle, kStop };
  /// Sends what is there. By whose turn it is; must not throw.
  using Send = std::function<void(By by)>;

  OfferBell(std::shared_ptr<WakeEvent> wake, Send send) : wake_(std::move(wake)), send_(std::move(send)) {}

  /// A few nanoseconds, and a call of the system if the network's thread sleeps and is to send.
  void Wake() noexcept override {
    if (is_sent_after_cycles_.load(std::memory_order_relaxed) && DoAfterCycle()) return;
    Ring();
  }
  /// That the network's thread is to look at it again. Any thread.
  void Ring() noexcept {
    turns_.Ring();
    wake_->Notify();
  }
  [[nodiscard]] bool has_rung() const noexcept { return turns_.has_rung(); }
  [[nodiscard]] bool Answer() noexcept { return turns_.Answer(); }

  /// Has what is there sent, by this thread or by who is at it already.
  void SendByNetwork() noexcept { TakeTurn(By::kNetwork); }
  /// Any thread: who stops the robot.
  void SendStop() noexcept { TakeTurn(By::kStop); }
  /// Whether values of cycles are sent after them from now on. By whose turn it is.
  void set_sent_after_cycles(bool value) noexcept { is_sent_after_cycles_.store(value, std::memory_order_relaxed); }

  /// Nothing is sent any more. Waits until who is at it has sent what there was.
  void Close() noexcept { turns_.Close(); }

 private:
  void RunAfterCycle() noexcept override { TakeTurn(By::kCycle); }
  void TakeTurn(By by) noexcept {
    // Who has come meanwhile may have stopped the robot. The network's thread may wait for the structure lock, so who has the
    // turn sends the safe value before it lets go.
    const auto look_again = [&] {
      send_(By::kStop);
      Ring();
    };
    turns_.Send([&] { send_(by); }, look_again);
  }

  const std::shared_ptr<WakeEvent> wake_;
  const Send send_;
  SendingTurns<> turns_;
  // relaxed: either way is right for each value, as turns keep their order.
  std::atomic<bool> is_sent_after_cycles_{false};
};

}  // namespace runnel
