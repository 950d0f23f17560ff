#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "plugins/command_service/application_log.h"
#include "plugins/command_service/command_request.h"
#include "plugins/command_service/command_worker.h"
#include "plugins/command_service/hand_leases.h"

namespace runnel {

/// Sets the value at a port by hand, from its text format (Port::PublishByHand()); fields that the text leaves
/// out have their usual values. Which port it was. Locks. Errors: no such port, with the nearest; no value of
/// its type; a type without a text format.
Result<std::string> SetPortByHand(Runtime& runtime, const std::string& path,
                                  const std::string& value);
/// Gives it back to its publishers, ends its block, too; "" : all that are set. Which these were. Errors: no such port;
/// nothing is set by hand there.
Result<std::string> ReleasePort(Runtime& runtime, const std::string& path);

/// What people set at the ports of an application: once, again and again, or with a deadline, by the machine's clock,
/// before which they have to be heard of again. When that has passed, readers of the port find the safe value of
/// its type until somebody releases it: its default (InputLimits), or else a value as it is made, a twist of 0. It
/// is not given back to its publishers: a robot that has just lost the person who drove it must not begin to drive by
/// itself.
///
/// Threads: the worker's; All() and LookAtDeadlines() by any. One of its own looks at deadlines, from the first on:
///          it waits for the structure lock, and for nothing else.
class HandSettings {
 public:
  /// `watched_clock`: for tests, of a machine whose deadlines only LookAtDeadlines() looks at.
  HandSettings(Runtime& runtime, CommandWorker& worker, ApplicationLog& log,
               const Clock* watched_clock = nullptr);
  ~HandSettings();

  struct Published {
    std::string port;
    bool goes_on = false;  ///< with a lease that was there
  };
  Result<Published> Publish(const PublishRequest& request);
  Result<std::string> Block(const BlockRequest& request);
  Result<std::string> Release(const ReleaseRequest& request);

  /// Publishes the safe value where a deadline has passed.
  void LookAtDeadlines();
  /// Ports that are set by hand or blocked, by path. Waits for nobody: while the structure is being changed, as before.
  [[nodiscard]] std::vector<std::pair<std::string, HandState>> All() const;
  /// Of the machine, from which deadlines count.
  [[nodiscard]] Time Now() const { return clock_.Now(); }

 private:
  struct HandSet {
    std::string path;
    std::shared_ptr<const void> value;
  };
  void PublishAgainAndAgain(HandSet set, std::uint64_t number, double rate);
  [[nodiscard]] bool IsLast(const std::string& port, std::uint64_t number) const;
  void Watch();

  Runtime& runtime_;
  ApplicationLog& log_;
  const SteadyClock machine_clock_;
  const Clock& clock_;
  const bool watches_;
  // Whoever publishes looks at them under the structure lock, which comes first, so that nothing is published after
  // a deadline has passed.
  mutable std::mutex mutex_;
  std::condition_variable has_changed_;
  HandLeases leases_;                                     // guarded by mutex_
  std::map<std::string, std::uint64_t, std::less<>> last_;  // so: which publishing at a port is the last one
  std::uint64_t count_ = 0;                               // so
  mutable std::vector<std::pair<std::string, HandState>> told_;  // so: by All()
  bool ends_ = false;                                     // so
  std::thread watch_;
  TaskGroup tasks_;  // first to go: its tasks use the rest
};

}  // namespace runnel
