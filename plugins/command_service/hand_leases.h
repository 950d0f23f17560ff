#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// How it stands with a port that is set by hand.
enum class HandState {
  kSet,      ///< until it is released
  kDriven,   ///< by somebody who has to be heard of again before a deadline
  kLost,     ///< who drove it was not heard of in time: readers find the safe value
  kStopped,  ///< readers find the safe value, and nobody may set another one
};
[[nodiscard]] const char* HandStateName(HandState state) noexcept;

/// Who sets which ports by hand, and until when he has to be heard of again. Only that: it publishes nothing.
///
/// Who drives gives his hold a name, a lease, which ends with the hold: what comes of it later, from a network that was
/// stuck or a page that was asleep, is refused. Who has a lease keeps others with leases off; people who just publish
/// take the port over, and a block ends everything.
///
/// Threads: one at a time. Times are the machine's.
class HandLeases {
 public:
  struct Request {
    std::string lease = {};                 ///< "": none
    std::optional<Duration> deadline = {};  ///< nothing: the last value of the lease, or one without
    Time received{};  ///< the deadline counts from here
  };

  /// Whether it may be published at the port. Errors: the port is driven by another one, the lease has
  /// ended, its deadline has passed already.
  [[nodiscard]] Result<void> Check(const std::string& port, const Request& request, Time now) const;
  /// That it has been. True: it goes on with a lease that is there.
  bool Note(const std::string& port, const Request& request);
  /// The port is no longer set by hand.
  void Forget(const std::string& port);
  void ForgetAll();

  /// Ports whose deadline has passed, which are lost now.
  [[nodiscard]] std::vector<std::pair<std::string, Duration>> Expire(Time now);
  /// When the next deadline ends.
  [[nodiscard]] std::optional<Time> next() const;
  [[nodiscard]] std::optional<HandState> StateOf(const std::string& port) const;
  /// By path.
  [[nodiscard]] std::vector<std::pair<std::string, HandState>> All() const;

 private:
  struct Hold {
    HandState state;
    std::string lease;
    Duration deadline{};
    Time due{};
  };
  void EndLeaseOf(const Hold& hold);

  std::map<std::string, Hold, std::less<>> holds_;  // by path
  std::deque<std::string> ended_;                   // leases, the newest of them
};

}  // namespace runnel
