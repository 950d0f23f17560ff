// What outranks, and what comes too fast.

#include <optional>
#include <string_view>

#include "plugins/command_service/request_table.h"
#include "plugins/inspector/internal/viewer_session.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kLongestStop = 1000;  // of its message, and of a sign of life
// Of messages that are refused unread: in longer ones the number of the request is not looked for, which takes time.
constexpr std::size_t kLongestNumbered = 16'384;

}  // namespace

// A release of the STOP outranks as well: it must neither wait nor be overtaken by a STOP that was pressed later.
WebArrival ViewerSession::OnArrival(std::string_view message, bool is_text) {
  WebArrival arrival{.mark = inspection_.application().runtime.robot_stop().requests()};
  const auto says = [head = message.substr(0, kLongestStop)](const char* text) { return head.find(text) != head.npos; };
  arrival.may_be_late = says(R"("op":"watch")") || says(R"("op":"unwatch")");
  if (!is_text || message.size() > kLongestStop || !(says("\"stop\"") || says("\"alive\""))) return arrival;
  const auto parsed = ParseViewerMessage(message);
  if (!parsed) return arrival;
  arrival.outranks = parsed->op == "stop" || (parsed->op == "release" && parsed->path == kRobotStopName);
  if (parsed->op == "alive" && role() >= WebRole::kDrive) {
    inspection_.service().operators().Hear(name_, parsed->at.value_or(Time()));
  }
  return arrival;
}

void ViewerSession::OnTooMany(std::string_view message, bool /*is_text*/) {
  if (IsSlow()) return;
  std::optional<std::uint64_t> request;
  if (message.size() <= kLongestNumbered) (void)ParseViewerMessage(message, &request);
  client_.SendText(Refusal(request, {{Error{.message = "too many requests a second"}}}));
}

}  // namespace runnel::internal
