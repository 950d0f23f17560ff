#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/port/port.h"
#include "plugins/command_service/command_service.h"
#include "plugins/foxglove/internal/client_message.h"
#include "plugins/foxglove/internal/directory.h"
#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/foxglove/internal/parameter_handler.h"
#include "plugins/foxglove/internal/server_messages.h"
#include "plugins/services/callable.h"
#include "plugins/values/watched_port.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// The channel on which a client publishes into an input: an output beside the application, connected to
/// the input for as long as this lives. Where something moves by it, the client drives it by hand instead, with a deadline:
/// the safe value is there at once when this goes, and after a while if the client falls silent (HandSettings).
///
/// Threads:    the server's; making and removing the output are left to the worker, which may wait.
/// Ownership:  what is shared outlives it, and sees to what it has left to do.
class ClientPublication {
 public:
  /// `wake` has the session take a turn, from any thread.
  ClientPublication(FoxgloveShared& shared, const DirectoryInput& input, std::function<void()> wake);
  ~ClientPublication();

  /// Publishes a value that is told in JSON as its channel would tell it; fields that are left out have
  /// their usual values. One that comes before the output is there, or while the structure is locked,
  /// waits, and only the last one does.
  /// `received`: by the machine's clock. Errors: the JSON is none of the type; the input cannot be had (any more).
  Result<void> Publish(std::string_view json, Time received);
  [[nodiscard]] const DirectoryInput& input() const noexcept { return input_; }
  /// What has come of making the output, once; nothing if that is not known yet, or all is well.
  [[nodiscard]] std::optional<Error> TakeError() { return std::exchange(error_, std::nullopt); }
  /// Whether values can be published (which some may still not be good for).
  [[nodiscard]] bool is_made() const noexcept { return is_made_; }
  /// Publishes what has waited. Whether it is still to be called.
  bool Continue();

 private:
  class Place;  // the output's, in the tree

  static Result<void> Make(FoxgloveShared& shared, const DirectoryInput& input, const std::string& name);
  Result<void> Drive(std::string_view json, Time received);
  Result<void> PublishWaiting();
  // Of what the client leaves out, the type's own value.
  Result<void> Read(std::string_view json, void* value) const;

  FoxgloveShared& shared_;
  const DirectoryInput input_;
  const TypeInfo& type_;
  const std::function<void()> wake_;
  const std::string place_;           // its name, below the root
  std::shared_ptr<WorkerTask> task_;  // until it is done
  bool is_made_ = false;
  std::optional<std::string> waiting_;
  RobotStop::AsOf as_of_;  // of what waits
  std::optional<Error> error_;
  // Of what drives: one hold, for as long as values come in time, and the newest of them while it is carried out.
  std::string lease_;
  Time heard_{};
  std::unique_ptr<PendingCommand> driving_;
  std::string usual_;  // the value that T{} has, as JSON
};

/// The channels that one client wants values of, and how it gets them: what is new, at most once each
/// Sample(), and nothing but the STOP, each second, while much is waiting for a client that is slow.
class Subscriptions {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  Subscriptions(const ServedApplication& application, WebClient& client) : application_(application), client_(client) {}

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
    std::string json;  // until it has begun
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
  std::map<std::uint32_t, std::unique_ptr<ClientPublication>>
      publications_;                                 // by the client's numbers; nullptr: of the STOP
  std::shared_ptr<const DirectoryContent> content_;  // that the client has been told of
  std::set<std::uint32_t> advertised_;
  bool has_graph_ = false;
  std::map<std::string, GraphTopic> graph_;  // that the client has been told of
  SteadyTime sample_at_{};
  SteadyTime time_at_{};
  std::optional<Time> time_;  // that the client has been told
};

}  // namespace runnel::internal
