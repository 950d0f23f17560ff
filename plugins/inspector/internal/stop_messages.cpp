#include "plugins/inspector/internal/stop_messages.h"

#include <utility>

#include "core/element/robot_stop.h"
#include "plugins/command_service/request_table.h"
#include "plugins/inspector/internal/requests.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr auto kPeriod = std::chrono::milliseconds(1000);

RobotStop& StopOf(const Inspection& inspection) {
  return inspection.application().runtime.robot_stop();
}

}  // namespace

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
  const bool is_press = message->op == "stop";
  if (!is_press && (message->op != "release" || message->path != kRobotStopName)) {
    return refuse({.message = "this connection knows no '" + message->op + "'",
                   .hint = "it bears 'stop', and 'release' with the path 'stop'"});
  }
  if (!is_press && inspection_.RoleOf(client_) < WebRole::kDrive) {
    return refuse({.message = "'release' is not allowed to who may only look",
                   .hint = "it takes a token for the role 'drive'"});
  }
  const auto done =
      inspection_.service().Begin(RobotStopRequest{is_press, name_}, inspection_.tasks());
  client_.SendText(ReplyTo(request, done->Take()));
}

}  // namespace runnel::internal
