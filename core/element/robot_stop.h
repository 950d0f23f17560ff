#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/stop_signal.h"

namespace runnel {

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
