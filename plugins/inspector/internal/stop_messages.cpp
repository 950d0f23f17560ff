#include "plugins/inspector/internal/stop_messages.h"

#include <utility>

#include "core/element/robot_stop.h"
#include "plugins/inspector/internal/requests.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr auto kPeriod = std::chrono::milliseconds(1000);

RobotStop& StopOf(const Inspection& inspection) {
  return inspection.application().runtime.robot_stop();
}

}  // namespace

std::string PressStop(Inspection& inspection, const ViewerMessage& message) {
  const bool is_new = StopOf(inspection).Press(message.client);
  if (is_new)
    inspection.application().log.Add(ApplicationLog::Kind::kWarning,
                                     "STOP is in force, by " + message.client);
  return Reply(message.request, is_new ? "STOP is in force" : "STOP was in force already");
}

std::string ReleaseStop(Inspection& inspection, const ViewerMessage& message) {
  if (!StopOf(inspection).Release(message.client))
    return Reply(message.request, "STOP was not in force");
  inspection.application().log.Add(ApplicationLog::Kind::kWarning,
                                   "STOP has been released, by " + message.client);
  return Reply(message.request, "STOP has been released");
}

LifeSign::LifeSign(Inspection& inspection, WebClient& client)
    : inspection_(inspection),
      client_(client),
      pressed_(StopOf(inspection).signal()->Listen(client.Waker())) {}

WebSession::SteadyTime LifeSign::Send() {
  const auto now = std::chrono::steady_clock::now();
  const RobotStop::State state = StopOf(inspection_).state();
  if (now < due_ && told_ == state.changes) return due_;
  const bool is_sent = client_.SendText(JsonObjectText([&](JsonObject& json) {
    json.Add("op", "alive");
    JsonObject stop(json.Key("stop"));
    stop.Add("in_force", state.in_force).Add("by", state.by);
    stop.Add("since", ToSeconds(state.since - inspection_.start()));
  }));
  if (is_sent) told_ = state.changes;
  return due_ = now + kPeriod;
}

StopSession::StopSession(Inspection& inspection, WebClient& client)
    : inspection_(inspection),
      client_(client),
      name_("viewer " + std::to_string(inspection.NumberViewer())),
      life_(inspection, client) {}

WebSession::SteadyTime StopSession::OnPoll() { return life_.Send(); }

void StopSession::OnBinary(std::string_view /*message*/) {
  client_.Close("messages of this protocol are text");
}

void StopSession::OnText(std::string_view text) {
  std::optional<std::uint64_t> request;
  auto message = ParseViewerMessage(text, &request);
  const auto refuse = [&](Error error) {
    client_.SendText(Refusal(request, {{std::move(error)}}));
  };
  if (!message) return refuse(message.error());
  message->client = name_;
  if (message->op == "stop") {
    client_.SendText(PressStop(inspection_, *message));
  } else if (message->op != "release_stop") {
    refuse({.message = "this connection knows no '" + message->op + "'",
            .hint = "it bears 'stop' and 'release_stop'"});
  } else if (inspection_.RoleOf(client_) < WebRole::kDrive) {
    refuse({.message = "'release_stop' is not allowed to who may only look",
            .hint = "it takes a token for the role 'drive'"});
  } else {
    client_.SendText(ReleaseStop(inspection_, *message));
  }
}

}  // namespace runnel::internal
