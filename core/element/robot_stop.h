#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/clock.h"
#include "core/base/result.h"

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

class Runtime;

/// The STOP of the robot: one for each Runtime. While it is in force, readers of each driving port (Port::SetDriving(),
/// InputOptions::drives) find its safe value, whoever publishes there, ports that come later included.
///
/// It needs neither the structure lock nor any thread but the caller's, so nothing that goes on in the application
/// delays it. It is no safety function in the sense of ISO 13850: a base must stand still by itself when
/// nobody commands it.
///
/// Threads:  any.
class RobotStop {
 public:
  struct State {
    bool in_force = false;
    std::string by = {};        ///< who changed it last, for people: "a terminal", "/robot/button"
    Time since{};               ///< of the last change, on the application's clock
    std::uint64_t changes = 0;  ///< 0: it was never in force
    /// How often it was pressed and released, presses while it was in force included: who releases has seen them all.
    std::uint64_t requests = 0;
    Time requested{};  ///< when the last of these was, on the machine's steady clock
  };

  /// When somebody asked for something, or what he knew then. If STOP was pressed or released since, it does not count: of
  /// what was held up it is not known what it would do now.
  struct AsOf {
    std::optional<Time> asked = {};              ///< on the machine's steady clock
    std::optional<std::uint64_t> requests = {};  ///< State::requests
  };

  explicit RobotStop(const Runtime& runtime);

  /// It is in force when this returns, whatever else is short. False: it was so before; `by` is not noted then.
  bool Press(std::string_view by) noexcept;
  /// Driving ports count what is stamped and published later than now. An error: it was not in force, or `as_of` does
  /// not know the STOP that is.
  Result<void> Release(std::string by, const AsOf& as_of);
  Result<void> Release(std::string by) { return Release(std::move(by), AsOf()); }

  /// State::requests. Wait-free; while it is being pressed or released, still that of before.
  [[nodiscard]] std::uint64_t requests() const noexcept { return requests_.load(std::memory_order_acquire); }
  /// Of what is asked for now and carried out later; `asked`: when, if somebody says so.
  [[nodiscard]] AsOf AsOfNow(std::optional<Time> asked = {}) const { return {asked, requests()}; }
  /// An error: STOP was pressed, or released, since what `as_of` knows of.
  Result<void> CheckIsKnown(const AsOf& as_of) const;

  [[nodiscard]] bool in_force() const noexcept { return signal_->in_force(); }
  [[nodiscard]] State state() const;
  /// For who follows it: StopSignal::Listen().
  [[nodiscard]] const std::shared_ptr<StopSignal>& signal() const noexcept { return signal_; }

 private:
  // Both with mutex_.
  void Note(bool in_force, std::string by);
  [[nodiscard]] bool IsKnown(const AsOf& as_of) const;

  const Runtime& runtime_;
  const std::shared_ptr<StopSignal> signal_ = std::make_shared<StopSignal>();  // outlives the runtime at readers
  mutable std::mutex mutex_;
  State state_;                             // guarded by mutex_, but for `requests`
  std::atomic<std::uint64_t> requests_{0};  // written with mutex_; release: pairs with the acquire in requests()
};

}  // namespace runnel
