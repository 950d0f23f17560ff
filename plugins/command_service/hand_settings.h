#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/lookout.h"
#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/port/hand_slot.h"
#include "core/types/any_value.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/command_request.h"
#include "plugins/command_service/command_worker.h"

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
  /// Takes over the first of `lease`, if there is one.
  void Add(std::list<std::string>& lease) noexcept;
  [[nodiscard]] bool Has(const std::string& lease) const;

 private:
  mutable std::mutex mutex_;
  std::list<std::string> leases_;  // the newest of them
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
    std::uint64_t stops = 0;                ///< RobotStop::State::requests
  };

  explicit HandHold(std::shared_ptr<EndedLeases> ended) : ended_(std::move(ended)) {}
  ~HandHold() override { EndLease(); }

  /// Whether it may be published at a port with this hold. Errors, without a path: the port is driven by another one, the
  /// lease has ended, STOP was pressed or released since it began (let go is accepted), its deadline has passed already.
  [[nodiscard]] Result<void> Check(const Request& request, Time now) const;
  /// That it is to be. True: it goes on with a lease that is there.
  bool Note(const Request& request);
  /// Its deadline has passed, and readers find the safe value.
  void NoteLost();

  [[nodiscard]] HandState state() const noexcept { return state_; }
  [[nodiscard]] Duration deadline() const noexcept { return deadline_; }
  /// When it was set for another purpose than to go on with a lease.
  [[nodiscard]] Time began() const noexcept { return began_; }
  /// When he has to be heard of; nothing if he need not.
  [[nodiscard]] std::optional<Time> due() const {
    if (state_ != HandState::kDriven) return {};
    return has_left() ? Time() : due_;
  }
  /// Who drives has said that he does so no longer (HandSettings::EndLease()).
  [[nodiscard]] bool has_left() const { return !lease_.empty() && ended_->Has(lease_.front()); }

  std::string path = {};     ///< of the port when it was set last, for people
  std::uint64_t number = 0;  ///< which publishing is the last one
  bool has_failed = false;   ///< to get the safe value, which has been told

 private:
  void EndLease() noexcept;
  [[nodiscard]] bool Has(const std::string& lease) const {
    return lease_.empty() ? lease.empty() : lease_.front() == lease;
  }

  const std::shared_ptr<EndedLeases> ended_;
  HandState state_ = HandState::kSet;
  std::list<std::string> lease_ = {};  // one or none; made with the hold, as there may be no memory when it ends
  Duration deadline_{};
  Time due_{};
  Time began_{};
  std::uint64_t stops_ = 0;
};

/// Sets the value at a port by hand, from its text format (Port::PublishByHand()); fields that the text leaves
/// out have their usual values. Which port it was. Locks. Errors: no such port, with the nearest; no value of
/// its type; a type without a text format; STOP was pressed or released meanwhile.
Result<std::string> SetPortByHand(Runtime& runtime, const std::string& path, const std::string& value);
/// Gives it back to its publishers, ends its block, too. Which port it was. Errors: no such port; nothing is set by hand there;
/// it was blocked or set, or STOP was pressed or released, after this was asked for.
Result<std::string> ReleasePort(Runtime& runtime, const std::string& path, RobotStop::AsOf as_of = {});

/// What people set at the ports of an application: once, again and again, or with a deadline, by the machine's clock,
/// before which they have to be heard of again. When that has passed, readers of the port find the safe value of
/// its type until somebody releases it: its default (InputLimits), or else a value as it is made, a twist of 0. It
/// is not given back to its publishers: a robot that has just lost the person who drove it must not begin to drive by
/// itself.
///
/// All of it is kept in the port's slot (HandSlot), and goes where the port goes: nothing here is found by a path.
///
/// Threads: the worker's; All(), EndLease() and LookAtDeadlines() by any. One of its own looks at deadlines, from the first on. It
///          takes a mutex for each slot, and neither the structure lock nor the worker: no change keeps it up.
class HandSettings {
 public:
  /// `watched_clock`: for tests, of a machine whose deadlines only LookAtDeadlines() looks at.
  HandSettings(Runtime& runtime, CommandWorker& worker, ApplicationLog& log, const Clock* watched_clock = nullptr);

  struct Published {
    std::string port;
    bool goes_on = false;  ///< with a lease that was there
  };
  /// `as_of`: one from before a STOP must not become one from after its release.
  Result<Published> Publish(const PublishRequest& request, RobotStop::AsOf as_of = {});
  Result<std::string> Block(const BlockRequest& request);

  /// Who drives with the lease does so no longer: readers find the safe value, at once, as if its deadline had passed. Nothing
  /// is waited for; any thread.
  void EndLease(const std::string& lease);
  /// Publishes the safe value where a deadline has passed. When the next one ends.
  std::optional<Time> LookAtDeadlines();
  /// Ports that are set by hand or blocked, by path. Waits for nobody: while the structure is being changed, as before.
  [[nodiscard]] std::vector<std::pair<std::string, HandState>> All() const;
  /// Of the machine, from which deadlines count.
  [[nodiscard]] Time Now() const { return clock_.Now(); }

 private:
  using Slot = std::shared_ptr<HandSlot>;
  void PublishAgainAndAgain(Slot slot, AnyValue value, std::uint64_t number, double rate, RobotStop::AsOf as_of);
  void WatchOver(const Slot& slot);
  std::optional<Time> LookAt(const Slot& slot);
  void TellFailure(HandHold& hold, const Error& error);

  Runtime& runtime_;
  ApplicationLog& log_;
  const SteadyClock machine_clock_;
  const Clock& clock_;
  const bool watches_;
  const std::shared_ptr<EndedLeases> ended_ = std::make_shared<EndedLeases>();
  mutable std::mutex mutex_;  // comes after the structure lock and after a slot's mutex
  std::vector<Slot> driven_;  // guarded by mutex_: those with a deadline
  mutable std::vector<std::pair<std::string, HandState>> told_;  // so: by All()
  std::atomic<std::uint64_t> count_{0};
  Lookout lookout_;
  TaskGroup tasks_;  // first to go: its tasks use the rest
};

}  // namespace runnel
