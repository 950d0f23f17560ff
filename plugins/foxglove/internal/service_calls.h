#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/foxglove/internal/directory.h"
#include "plugins/services/callable.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

struct FoxgloveShared;
class SendQueue;

/// What one client is told of services, and its calls that are under way; they are given up when it goes.
///
/// Threads: the server's.
class ServiceCalls {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  ServiceCalls(FoxgloveShared& shared, SendQueue& send_queue, WebClient& client)
      : shared_(shared), send_queue_(send_queue), client_(client) {}

  /// Tells of services that have come and gone; who may not call is told of the STOP alone.
  void Follow(const DirectoryContent& content, bool may_call);
  /// Whether calling it is a STOP of the robot.
  [[nodiscard]] bool IsStop(std::uint32_t service) const;
  /// A binary message: a call. `may_call`: else it is refused, but for the STOP.
  void Begin(std::string_view message, bool may_call);
  /// Answers what can be answered. When it wants to be called again.
  SteadyTime Continue(SteadyTime now);

 private:
  struct Pending {
    std::uint32_t service;
    std::uint32_t call;
    std::string path;
    std::string json;               // until it has begun
    std::unique_ptr<AnyCall> begun;
    const TypeInfo* reply = nullptr;
  };

  void Fail(const Pending& pending, const Error& error);
  /// Whether it is still under way.
  bool ContinueOne(Pending& pending);
  bool TryBegin(Pending& pending);
  void SendReply(const Pending& pending);

  FoxgloveShared& shared_;
  SendQueue& send_queue_;
  WebClient& client_;
  std::map<std::uint32_t, std::string> advertised_;  // paths
  std::vector<Pending> pending_;
};

}  // namespace runnel::internal
