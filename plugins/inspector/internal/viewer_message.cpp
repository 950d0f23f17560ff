#include "plugins/inspector/internal/viewer_message.h"

#include <utility>

#include "core/base/characters.h"
#include "core/base/number_text.h"
#include "plugins/command_service/request_table.h"
#include "plugins/inspector/internal/viewer_session.h"

namespace runnel::internal {

namespace {

constexpr int kDeepest = 4;
constexpr std::size_t kLongestStop = 1000;  // of its message, and of a sign of life
// Of messages that are refused unread: longer ones are not parsed for the number of the request, which takes time.
constexpr std::size_t kLongestNumbered = 16'384;
constexpr std::size_t kLongestName = 100;  // what is longer names nothing, and is repeated and compared with what does
// Whole numbers that every JSON reader gets right.
constexpr std::uint64_t kLargestWhole = 9007199254740992;

// Of a message in which it is the last member, as in the page's.
std::optional<std::uint64_t> NumberAtEnd(std::string_view message) {
  constexpr std::string_view kLast = R"(,"request":)";  // within a text there would be a backslash
  const std::size_t place = message.rfind(kLast);
  if (place == message.npos || !message.ends_with('}')) return {};
  message.remove_prefix(place + kLast.size());
  return NumberIn<std::uint64_t>(message.substr(0, message.size() - 1));
}

using Text = std::pair<const char*, std::string ViewerMessage::*>;
constexpr Text kTexts[] = {{"op", &ViewerMessage::op},         {"path", &ViewerMessage::path},
                           {"label", &ViewerMessage::label},   {"file", &ViewerMessage::file},
                           {"plugin", &ViewerMessage::plugin}, {"level", &ViewerMessage::level},
                           {"from", &ViewerMessage::from},     {"to", &ViewerMessage::to},
                           {"value", &ViewerMessage::value},   {"lease", &ViewerMessage::lease}};

// A member that has but one word, or is left out.
bool IsSaid(const std::string& name, const std::string& word, JsonMembers& members) {
  const auto said = members.Text(name);
  if (said && *said != word) members.Complain("\"" + name + "\" is '" + word + "' or left out, not '" + *said + "'");
  return said.has_value();
}

void ReadChanges(const std::vector<JsonPart>& changes, ViewerMessage& message) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    auto change = ParseChange(changes[i]);
    if (change) {
      message.changes.push_back(std::move(*change));
    } else {
      message.wrong_changes.push_back({change.error(), i});
    }
  }
}

}  // namespace

Result<ViewerMessage> ParseViewerMessage(std::string_view text, std::optional<std::uint64_t>* number) {
  const auto json = JsonPart::Parse(text, kDeepest);
  if (!json) return json.error().WithContext("the message cannot be read");
  if (!json->is_object()) return Error{.message = "the message is not a JSON object"};
  ViewerMessage message;
  JsonMembers members(*json);
  message.request = members.Count("request", kLargestWhole);
  if (number != nullptr) *number = message.request;
  for (const auto& [name, value] : json->members()) message.fields.push_back(Shortened(name, kLongestName));
  for (const auto& [name, member] : kTexts) message.*member = members.Text(name).value_or("");
  message.op = Shortened(std::move(message.op), kLongestName);
  if (const auto changes = members.List("changes")) ReadChanges(*changes, message);
  if (const JsonPart* const entries = members.Find("entries")) {
    if (!entries->is_object()) members.Complain("\"entries\" must be an object");
    for (const auto& [name, value] : entries->members()) {
      if (!value.text()) members.Complain("the entry '" + name + "' must be a text");
      message.entries[name] = value.text().value_or("");
    }
  }
  message.wants_image = IsSaid("as", "image", members);
  message.saves_configuration = IsSaid("what", "configuration", members);
  message.is_on = members.Flag("on").value_or(message.is_on);
  message.overwrites = members.Flag("overwrite").value_or(message.overwrites);
  message.may_end_application = members.Flag("yes").value_or(message.may_end_application);
  message.rate = members.Number("rate");
  message.deadline = members.Number("deadline");
  if (const auto at = members.Number("at")) message.at = Time(FromSeconds(std::clamp(*at, 0.0, 9e9)));
  message.speed = members.Number("speed");
  message.elements = members.Count("elements", kLargestWhole).value_or(message.elements);
  message.cycles = members.Count("cycles", kLargestWhole).value_or(message.cycles);
  if (members.error()) {
    return message.op.empty() ? *members.error() : members.error()->WithContext("'" + message.op + "'");
  }
  if (message.op.empty()) return Error{.message = "the message has no \"op\""};
  return message;
}

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
  if (message.size() > kLongestNumbered) {
    request = NumberAtEnd(message);
  } else {
    (void)ParseViewerMessage(message, &request);
  }
  client_.SendText(Refusal(request, {{Error{.message = "too many requests a second"}}}));
}

}  // namespace runnel::internal
