#include "plugins/foxglove/internal/robot_stop_access.h"

#include <limits>

#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/values/json_reader.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr const char* kReplySchema =
    R"({"type":"object","properties":{"success":{"type":"boolean"},"message":{"type":"string"}}})";

// What cannot be read presses: somebody has asked for a STOP.
bool SaysFalse(std::string_view json) {
  const auto said = JsonPart::Parse(json);
  return said && (said->boolean() == false || JsonMembers(*said).Flag("data") == false);
}

// A call may have been under way for seconds, and the protocol does not say when it was sent: so it says which STOP it ends.
CommandAnswer Release(FoxgloveShared& shared, std::string_view json) {
  std::optional<std::uint64_t> number;
  if (const auto said = JsonPart::Parse(json)) {
    JsonMembers members(*said);
    number = members.Count("number", std::numeric_limits<std::uint64_t>::max());
    members.RefuseOthers();
    if (members.error()) return CommandAnswer::Refused(members.error()->WithContext(std::string(kReleaseName)));
  }
  if (!number) {
    const auto requests = shared.runtime().robot_stop().requests();
    return CommandAnswer::Refused(
        {.message = "say which STOP is meant: {\"number\": " + std::to_string(requests) + "}"});
  }
  return shared.application.service
      .Begin(RobotStopRequest{false, "Foxglove"}, *shared.tasks, {}, {.asked = {}, .requests = number})
      ->Take();
}

}  // namespace

std::vector<DirectoryService> StopServices() {
  const auto service = [](std::string_view name, const char* type, const char* schema) {
    DirectoryService made{.name = std::string(name), .path = std::string(name), .type = type};
    made.request_schema = schema;
    made.reply_schema = kReplySchema;
    return made;
  };
  return {service(kStopName, "STOP of the robot: true presses",
                  R"({"type":"object","properties":{"data":{"type":"boolean"}}})"),
          service(kReleaseName, "ends the STOP of the robot",
                  R"({"type":"object","properties":{"number":{"type":"integer"}}})")};
}

FoxgloveChannel StopChannel() {
  return {
      std::string(kStopName), "runnel.Stop",
      R"({"type":"object","properties":{"data":{"type":"boolean"},"by":{"type":"string"},"since":{"type":"number"},)"
      R"("number":{"type":"integer"}}})",
      [](const void* value, Time, std::string& json) {
        const auto& state = *static_cast<const RobotStop::State*>(value);
        JsonObject message(json);
        message.Add("data", state.in_force).Add("by", state.by);
        message.Add("since", ToSeconds(state.since.time_since_epoch())).Add("number", state.requests);
      }};
}

std::string SetStop(FoxgloveShared& shared, std::string_view name, std::string_view json) {
  CommandAnswer answer = CommandAnswer::Done("false does nothing; " + std::string(kReleaseName) + " releases");
  if (name == kReleaseName) {
    answer = Release(shared, json);
  } else if (!SaysFalse(json)) {
    answer = shared.application.service.Begin(RobotStopRequest{true, "Foxglove"}, *shared.tasks)->Take();
  }
  const std::string problems = answer.diagnostics.ToString();
  const std::string text = answer.text + (answer.text.empty() || problems.empty() ? "" : "\n") + problems;
  const bool has_stopped = answer && !answer.stops_nothing && !answer.leaves_some;
  return JsonObjectText([&](JsonObject& reply) { reply.Add("success", has_stopped).Add("message", text); });
}

}  // namespace runnel::internal
