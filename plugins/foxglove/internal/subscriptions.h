#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "plugins/command_service/command_service.h"
#include "plugins/foxglove/internal/client_message.h"
#include "plugins/foxglove/internal/directory.h"
#include "plugins/values/watched_port.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// The channels that one client wants values of, and how it gets them: what is new, at most once each
/// Sample(), and nothing but the STOP, each second, while much is waiting for a client that is slow.
class Subscriptions {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  Subscriptions(const ServedApplication& application, WebClient& client)
      : application_(application), client_(client) {}

  /// Returns what is wrong with it; the rest is done.
  std::vector<Error> Add(const SubscribeMessage& message, const DirectoryContent& content);
  std::vector<Error> Remove(const UnsubscribeMessage& message);
  /// Lets go of those whose channels are gone.
  void Retain(const DirectoryContent& content);

  /// Sends what is new. False if the structure was locked: to be tried again soon.
  bool Sample(SteadyTime now);
  /// What has become of values whose types throw when they are written: nobody is subscribed to them any
  /// more.
  [[nodiscard]] std::vector<Error> TakeFailures() { return std::exchange(failures_, {}); }
  [[nodiscard]] bool is_empty() const noexcept { return by_id_.empty(); }

 private:
  struct Subscription {
    DirectoryChannel channel;
    std::unique_ptr<WatchedPort> port;  // nullptr for the log and the STOP
    bool is_found = false;
    std::uint64_t next = 0;  // entry of the log, or change of the STOP
    SteadyTime told_at{};    // of the STOP
  };

  [[nodiscard]] static Subscription To(const DirectoryChannel& channel);
  void ShowStop(std::uint32_t id, Subscription& subscription, SteadyTime now);
  void ShowLog(std::uint32_t id, Subscription& subscription);

  // False if its type has thrown.
  bool Show(std::uint32_t id, Subscription& subscription);

  const ServedApplication& application_;
  WebClient& client_;
  std::map<std::uint32_t, Subscription> by_id_;
  std::vector<Error> failures_;
  std::uint64_t found_at_ = 0;  // the structure's revision when the ports were found
  bool is_any_lost_ = true;     // not all ports have been found
};

}  // namespace runnel::internal
