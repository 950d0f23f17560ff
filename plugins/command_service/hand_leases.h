#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/port/hand_slot.h"

namespace runnel {

/// How it stands with a port that is set by hand.
enum class HandState {
  kSet,      ///< until it is released
  kDriven,   ///< by somebody who has to be heard of again before a deadline
  kLost,     ///< who drove it was not heard of in time: readers find the safe value
  kStopped,  ///< readers find the safe value, and nobody may set another one
};
[[nodiscard]] const char* HandStateName(HandState state) noexcept;

/// Leases that have ended: what comes of them later, from a network that was stuck or a page that was asleep, is refused.
/// Threads: any.
class EndedLeases {
 public:
  void Add(const std::string& lease);
  [[nodiscard]] bool Has(const std::string& lease) const;

 private:
  mutable std::mutex mutex_;
  std::deque<std::string> leases_;  // the newest of them
};

/// Who sets a port by hand, and until when he has to be heard of again. Only that: it publishes nothing. It lies in the
/// port's slot, and goes where that goes.
///
/// Who drives gives his hold a name, a lease, which ends with the hold. Who has a lease keeps others with leases off; people
/// who just publish take the port over, and a block or release ends everything.
///
/// Threads: one at a time (HandSlot::mutex). Times are the machine's.
class HandHold final : public HandSlot::Hold {
 public:
  struct Request {
    std::string lease = {};                 ///< "": none
    std::optional<Duration> deadline = {};  ///< nothing: the last value of the lease, or one without
    Time received{};                        ///< the deadline counts from here
  };

  explicit HandHold(std::shared_ptr<EndedLeases> ended) : ended_(std::move(ended)) {}
  ~HandHold() override { EndLease(); }

  /// Whether it may be published at a port with this hold. Errors, without a path: the port is driven by another one, the
  /// lease has ended, its deadline has passed already.
  [[nodiscard]] Result<void> Check(const Request& request, Time now) const;
  /// That it is to be. True: it goes on with a lease that is there.
  bool Note(const Request& request);
  /// Its deadline has passed, and readers find the safe value.
  void NoteLost();

  [[nodiscard]] HandState state() const noexcept { return state_; }
  [[nodiscard]] Duration deadline() const noexcept { return deadline_; }
  /// When he has to be heard of; nothing if he need not.
  [[nodiscard]] std::optional<Time> due() const noexcept {
    return state_ == HandState::kDriven ? std::optional(due_) : std::nullopt;
  }

  std::string path = {};     ///< of the port when it was set last, for people
  std::uint64_t number = 0;  ///< which publishing is the last one
  bool has_failed = false;   ///< to get the safe value, which has been told

 private:
  void EndLease();

  const std::shared_ptr<EndedLeases> ended_;
  HandState state_ = HandState::kSet;
  std::string lease_ = {};
  Duration deadline_{};
  Time due_{};
};

}  // namespace runnel
