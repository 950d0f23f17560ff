#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>

#include "plugins/foxglove/internal/client_publication.h"
#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/foxglove/internal/parameter_handler.h"
#include "plugins/foxglove/internal/send_queue.h"
#include "plugins/foxglove/internal/server_messages.h"
#include "plugins/foxglove/internal/service_calls.h"
#include "plugins/foxglove/internal/subscriptions.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// The protocol with one client.
class FoxgloveSession final : public WebSession {
 public:
  FoxgloveSession(std::shared_ptr<FoxgloveShared> shared, WebClient& client);

  void OnText(std::string_view message) override;
  void OnBinary(std::string_view message) override;
  bool OutranksLimits(std::string_view message, bool is_text) const override;
  SteadyTime OnPoll() override;

 private:
  void Hear();
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

  /// Whether the client may do what takes `needed`; if not, it is told.
  bool MayDo(WebRole needed, std::string_view what);
  void SendStatus(StatusLevel level, const Error& error);
  void SendError(const Error& error) { SendStatus(StatusLevel::kError, error); }
  void FollowStructure();
  void AdvertiseNew();
  void DropPublications(const DirectoryContent& content);
  bool ContinuePublications();
  void SendTime(SteadyTime now);

  struct Publication {
    std::string path;  // of the input
    const TypeInfo* type;
    std::unique_ptr<ClientPublication> channel;
  };

  const std::shared_ptr<FoxgloveShared> shared_;
  WebClient& client_;
  SendQueue send_queue_;
  Subscriptions subscriptions_;
  ParameterHandler parameters_;
  ServiceCalls calls_;
  std::map<std::uint32_t, Publication> publications_;  // by the client's numbers
  std::shared_ptr<const DirectoryContent> content_;    // that the client has been told of
  std::set<std::uint32_t> advertised_;
  bool has_graph_ = false;
  std::map<std::string, GraphTopic> graph_;  // that the client has been told of
  SteadyTime sample_at_{};
  SteadyTime time_at_{};
  std::optional<Time> time_;  // that the client has been told
};

}  // namespace runnel::internal
