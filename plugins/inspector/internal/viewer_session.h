#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plugins/inspector/internal/inspection.h"
#include "plugins/inspector/internal/requests.h"
#include "plugins/inspector/internal/viewer_message.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/watched_port.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// What is said to one viewer. See PROTOCOL.md.
///
/// Threads:  the server's.
class ViewerSession final : public WebSession {
 public:
  /// Of connections that bear the STOP, signs of life, and nothing else, so that nothing delays it.
  static constexpr const char* kStopProtocol = "runnel.stop.v1";

  ViewerSession(Inspection& inspection, WebClient& client);

  void OnText(std::string_view message) override;
  void OnBinary(std::string_view /*message*/) override { client_.Close("messages of this protocol are text"); }
  WebArrival OnArrival(std::string_view message, bool is_text) override;
  void OnTooMany(std::string_view message, bool is_text) override;
  SteadyTime OnPoll() override;

 private:
  struct Watch {
    WatchedPort port;
    Duration interval;
    std::size_t elements;
    bool wants_image = false;
    SteadyTime due{};
    std::string service = {};  // how it is doing, if it is one, as JSON
    bool is_service_told = true;
    const TypeInfo* pictured = nullptr;           // the type that `picture` is of
    std::optional<FoxgloveChannel> picture = {};  // as Foxglove has it, which browsers can show
  };
  void SendHello();
  // How it stands with the STOP: each second, and when it changes. When it wants the next turn.
  SteadyTime SendAlive();
  void SendStructure();
  void SendArrangement();
  void SendLog();
  void SendNetwork(SteadyTime now);
  void SendState(SteadyTime now);
  void SendReplies();
  void SendValues(SteadyTime now);
  // Whether the port is a service, and does otherwise than told last. Under the structure lock.
  static void NoteService(Watch& watch);
  // The value as JSON; false if not all of it.
  static bool AppendValue(Watch& watch, const void* value, Time time, std::string& json);
  // How many values there have been, and the newest as JSON; nothing if there is no new one.
  std::optional<std::uint64_t> LookAt(Watch& watch, std::string& item) const;
  void SendRates(SteadyTime now);
  void SendProfile();
  void BeginWatching(const ViewerMessage& message);
  void BeginRequest(const Operation& operation, ViewerMessage message);
  void Refuse(const ViewerMessage& message, Error error);
  void RefuseRole(const ViewerMessage& message, WebRole needed);
  [[nodiscard]] bool IsSlow() const;
  [[nodiscard]] WebRole role() const { return inspection_.options().is_read_only ? WebRole::kLook : client_.role(); }

  Inspection& inspection_;
  WebClient& client_;
  const std::string name_;
  const bool is_for_stop_;
  const StopSignal::Subscription pressed_;  // gives the session a turn
  std::optional<std::uint64_t> told_stop_;  // of its requests
  SteadyTime alive_due_{};
  std::shared_ptr<const Catalogue> catalogue_;
  std::uint64_t structure_ = 0;    // the revision that has been told
  std::uint64_t arrangement_ = 0;  // the revision that has been told
  std::optional<std::uint64_t> log_;
  std::string network_;  // as it was told
  SteadyTime network_due_{};
  std::string state_;  // as it was told, without the time
  Duration state_time_{-1};
  SteadyTime state_due_{};
  std::vector<ViewerRequest> pending_;
  std::deque<std::string> replies_;  // that the client has not taken yet
  std::map<std::string, Watch, std::less<>> watches_;
  Duration rates_interval_{};  // 0: not wanted
  SteadyTime rates_due_{};
  std::optional<CountSample> counted_;
  bool has_profile_ = false;     // that the viewer has been told
  std::vector<ToldRate> rates_;  // as they were told, of counted_
};

}  // namespace runnel::internal
