#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/channel/subscribers.h"
#include "core/lockfree/wake_event.h"
#include "core/module/after_cycle.h"
#include "core/port/port_stop.h"
#include "core/port/probe_port.h"
#include "plugins/network/network_options.h"
#include "plugins/network/sending_turns.h"
#include "plugins/network_discovery/value_form.h"
#include "plugins/ros_services/ros_time.h"
#include "plugins/wire/octet_pool.h"

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
    // Who has come meanwhile may have stopped the robot. The network's thread may wait for the structure lock, so who
    // has the turn sends the safe value before it lets go.
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

/// One port whose values go to the network, each as soon as it is published, while somebody there reads it. Until then
/// nothing of the port knows of it.
///
/// Which thread sends them: the network's, which publishers wake by a few nanoseconds, and a call of the system if it
/// sleeps. With ValueSending::kAfterCycle, what has been published in a cycle is sent by that cycle's thread when it has
/// ended, if values are small. Both may be at it in turn (OfferBell).
///
/// While the robot is stopped, a port that drives, or whose values are velocities, sends its safe value instead, at once, by
/// the thread of who presses, and again and again; after the release only what is later than that.
///
/// Threads:     all by the network's thread, outside of cycles, Attach() under the structure lock, too; but Forget(), by
///              who has that lock, as is_renamed() and set_renamed(), and is_stopped(), by any.
/// Allocation:  of octets, which are used again.
class OfferedPort {
 public:
  /// `beside`: an element beside the tree, below which the input is. `wake` wakes the thread that calls Send().
  OfferedPort(FrameworkElement& beside, const std::string& name, const TypeInfo& type, std::string path,
              OfferOptions options, std::shared_ptr<const ValueForm> form, ClockOffset clock,
              std::shared_ptr<WakeEvent> wake);
  ~OfferedPort();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] const TypeInfo& type() const noexcept;
  [[nodiscard]] const OfferOptions& options() const noexcept { return options_; }
  [[nodiscard]] WireEndpointOptions endpoint() const;
  /// Once it has begun.
  [[nodiscard]] const WireId& id() const noexcept { return writer_->id(); }

  [[nodiscard]] bool HasReader(std::uint64_t reader) const { return writer_->HasReader(reader); }

  /// Told, by threads of the engine, that somebody begins or ceases to read. Before Begin().
  void set_on_matched(std::function<void()> on_matched) { on_matched_ = std::move(on_matched); }
  /// Errors: of the engine.
  Result<void> Begin(WireParticipant& participant);
  /// Takes values of the port from now on, if anybody there reads them; nullptr: of none, as it has gone.
  void Attach(Port* port);
  /// Whether its port has another path now, by which it will not come back. Under the structure lock.
  [[nodiscard]] bool is_renamed() const noexcept { return is_renamed_; }
  void set_renamed(bool value) noexcept { is_renamed_ = value; }
  /// The element is about to go: nobody looks at a port of it any more.
  void Forget(const FrameworkElement& element) noexcept;

  /// Sends what is due. When it wants to be called again though nothing wakes; nothing: not before.
  std::optional<Time> Send(Time now);

  /// Whether its safe value is sent, as the robot or this port is stopped.
  [[nodiscard]] bool is_stopped() const;
  [[nodiscard]] std::size_t matched() const noexcept { return matched_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return each_ ? each_->dropped() : 0; }
  /// Of those sent: how many by threads of cycles.
  [[nodiscard]] std::uint64_t sent_after_cycles() const noexcept {
    return sent_after_cycles_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] bool has_error() const;
  /// What went wrong since the last call.
  [[nodiscard]] std::optional<Error> TakeError();

 private:
  struct Binding;
  class Reader;

  void SetBinding(const Port* source, std::vector<internal::PassedStop> stops);  // under the structure lock
  // By who has the turn.
  void SendBy(OfferBell::By by) noexcept;
  void SendSafeValue();
  bool SendNewest();  // whether there was one
  void SendEach(std::size_t most);
  [[nodiscard]] Time StampOf(ValueTimes times);
  void Write(const std::shared_ptr<Octets>& octets, Time stamp);  // since 1970
  void Fail() noexcept;                                           // within a handler

  const std::string path_;
  const OfferOptions options_;
  const std::string topic_;
  const std::shared_ptr<const ValueForm> form_;
  const ClockOffset clock_;
  const std::shared_ptr<OfferBell> bell_;
  std::unique_ptr<Reader> reader_;
  std::unique_ptr<ProbePort> each_;  // if each value is wanted
  std::function<void()> on_matched_;
  std::unique_ptr<WireWriter> writer_;
  std::atomic<std::size_t> matched_{0};
  bool is_renamed_ = false;  // under the structure lock
  // Changed under the structure lock; who has loaded it in an EpochGuard may use it, and its source, as long as that lives.
  std::atomic<Binding*> binding_{nullptr};
  std::vector<StopSignal::Subscription> stop_subscriptions_;  // under the structure lock
  OctetPool pool_;
  Time next_{};  // not before
  /// Of the newest value that was sent.
  struct Shown {
    std::uint64_t binding;
    std::uint64_t count;  // how many the source had published
    bool operator==(const Shown&) const = default;
  };
  std::optional<Shown> shown_;  // by who has the turn
  /// What stamp the last value has got.
  struct Stamped {
    ValueTimes times;
    Time stamp;
  };
  std::optional<Stamped> stamped_;         // by who has the turn
  bool is_large_ = false;                  // by who has the turn
  std::int64_t bar_ = StopSignal::kNever;  // of the stops, as it was seen last; by who has the turn
  Time again_{};                           // not before; by who has the turn
  std::atomic<bool> is_left_{false};       // something could not be sent, as for want of memory
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> sent_after_cycles_{0};
  mutable std::mutex mutex_;
  std::optional<Error> error_;  // of the engine; guarded by mutex_
  std::exception_ptr failure_;  // guarded by mutex_
};

}  // namespace runnel
