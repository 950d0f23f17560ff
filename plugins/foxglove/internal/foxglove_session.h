#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/foxglove/internal/client_publication.h"
#include "plugins/foxglove/internal/directory.h"
#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/foxglove/internal/parameter_handler.h"
#include "plugins/foxglove/internal/send_queue.h"
#include "plugins/foxglove/internal/server_messages.h"
#include "plugins/foxglove/internal/subscriptions.h"
#include "plugins/services/callable.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

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
  /// Whether calling it is a STOP of the robot, or ends one (kReleaseName).
  [[nodiscard]] bool Is(std::string_view name, std::uint32_t service) const;
  /// A binary message: a call. `may_call`: else it is refused, but for the STOP. `is_meant`: likewise, if it is an error.
  void Begin(std::string_view message, bool may_call, const Result<void>& is_meant);
  /// Answers what can be answered. When it wants to be called again.
  SteadyTime Continue(SteadyTime now);

 private:
  struct Pending {
    std::uint32_t service;
    std::uint32_t call;
    std::string path;
    std::string json;               // until it has begun
    std::unique_ptr<AnyCall> begun;
    RobotStop::AsOf as_of = {};
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

/// The protocol with one client.
class FoxgloveSession final : public WebSession {
 public:
  FoxgloveSession(std::shared_ptr<FoxgloveShared> shared, WebClient& client);

  void OnText(std::string_view message) override;
  void OnBinary(std::string_view message) override;
  WebArrival OnArrival(std::string_view message, bool is_text) override;
  void OnTooMany(std::string_view message, bool is_text) override;
  SteadyTime OnPoll() override;

 private:
  void Handle(const SubscribeMessage& message);
  void Handle(const UnsubscribeMessage& message);
  void Handle(const AdvertiseMessage& message);
  void Handle(const UnadvertiseMessage& message);
  void Handle(const GetParametersMessage& message) { parameters_.Get(message); }
  void Handle(const SetParametersMessage& message) { parameters_.Set(message); }
  void Handle(const SubscribeParametersMessage& message) { parameters_.Subscribe(message); }
  void Handle(const SubscribeGraphMessage& message);
  /// `may_search`: for the nearest name, which takes time; once in a message.
  void Advertise(const AdvertiseMessage::Channel& channel, bool& may_search);

  /// An error: STOP has been pressed or released since the message came that is being handed over.
  [[nodiscard]] Result<void> CheckIsMeant() const;
  /// Whether the client may do what takes `needed`, and it is still meant; if not, it is told.
  bool MayDo(WebRole needed, std::string_view what);
  void SendStatus(StatusLevel level, const Error& error);
  void SendError(const Error& error) { SendStatus(StatusLevel::kError, error); }
  void FollowStructure();
  void AdvertiseNew();
  void DropPublications(const DirectoryContent& content);
  bool ContinuePublications();
  void SendTime(SteadyTime now);

  const std::shared_ptr<FoxgloveShared> shared_;
  WebClient& client_;
  SendQueue send_queue_;
  Subscriptions subscriptions_;
  ParameterHandler parameters_;
  ServiceCalls calls_;
  std::map<std::uint32_t, std::unique_ptr<ClientPublication>> publications_;  // by the client's numbers; nullptr: of the STOP
  std::shared_ptr<const DirectoryContent> content_;    // that the client has been told of
  std::set<std::uint32_t> advertised_;
  bool has_graph_ = false;
  std::map<std::string, GraphTopic> graph_;  // that the client has been told of
  SteadyTime sample_at_{};
  SteadyTime time_at_{};
  std::optional<Time> time_;  // that the client has been told
};

}  // namespace runnel::internal
