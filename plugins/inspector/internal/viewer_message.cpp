#include "plugins/inspector/internal/viewer_message.h"

#include <algorithm>
#include <utility>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/element/tags.h"
#include "plugins/command_service/request_table.h"
#include "plugins/inspector/internal/viewer_session.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::internal {

namespace {

constexpr int kDeepest = 4;
constexpr std::size_t kLongestStop = 1000;  // of its message, and of a sign of life
// Of messages that are refused unread: in longer ones the number of the request is not looked for, which takes time.
constexpr std::size_t kLongestNumbered = 16'384;
constexpr std::size_t kLongestName = 100;  // what is longer names nothing, and is repeated and compared with what does
// Whole numbers that every JSON reader gets right.
constexpr std::uint64_t kLargestWhole = 9007199254740992;

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
  if (message.size() <= kLongestNumbered) (void)ParseViewerMessage(message, &request);
  client_.SendText(Refusal(request, {{Error{.message = "too many requests a second"}}}));
}

namespace {

// Of a Port::Direction, in their order.
const std::vector<std::string> kDirectionNames{"input", "output"};
constexpr std::uint64_t kLargestCount = 1'000'000'000;

// `names`: of the values of T, in their order; the first one is meant where nothing is said.
template <typename T>
T OneOf(JsonMembers& members, const std::string& key, const std::vector<std::string>& names) {
  const std::string word = members.Text(key).value_or(names.front());
  const auto found = std::ranges::find(names, word);
  if (found != names.end()) return static_cast<T>(found - names.begin());
  members.Complain("\"" + key + "\" cannot be '" + word + "'", NearestNameHint(word, names));
  return {};
}

// {"step": "0.1"}: values of parameters in their text format.
std::vector<Setting> SettingsIn(JsonMembers& members) {
  std::vector<Setting> settings;
  const JsonPart* const found = members.Find("settings");
  if (found == nullptr) return settings;
  if (!found->is_object()) members.Complain("\"settings\" must be an object");
  for (const auto& [name, value] : found->members()) {
    auto text = value.text();
    if (!text) members.Complain("the setting '" + name + "' must be a text");
    settings.push_back({name, std::move(text).value_or("")});
  }
  return settings;
}

Change ReadConnect(JsonMembers& m) {
  return ConnectPorts{m.NeedText("from"),
                      m.NeedText("to"),
                      {.queue = m.Count("queue", kLargestCount).value_or(0),
                       .on_full = OneOf<OnFull>(m, "on_full", OnFullNames()),
                       .pull = m.Flag("pull").value_or(false),
                       .when_present = m.Flag("when_present").value_or(false),
                       .late = m.Flag("late").value_or(false),
                       .convert = m.Text("convert").value_or("")}};
}
Change ReadReplace(JsonMembers& m) {
  ReplaceModule change{m.NeedText("path"), m.NeedText("type"), SettingsIn(m)};
  change.probation_cycles = m.Count("probation", kLargestCount).value_or(change.probation_cycles);
  return change;
}
Change ReadLog(JsonMembers& m) {
  std::vector<std::string> levels(LogLevelNames().begin(), LogLevelNames().end());
  levels.emplace_back("inherit");
  LogElement change{m.NeedText("path")};
  (void)m.NeedText("level");
  const auto level = OneOf<LogLevel>(m, "level", levels);
  if (static_cast<std::size_t>(level) + 1 < levels.size()) change.level = level;
  return change;
}

// In seconds.
std::optional<Duration> PeriodIn(JsonMembers& m) {
  const auto seconds = m.Number("period");
  return seconds ? std::optional(FromSeconds(*seconds)) : std::nullopt;
}
std::optional<int> PriorityIn(JsonMembers& m) {
  const auto priority = m.Count("priority", 99);
  return priority ? std::optional(static_cast<int>(*priority)) : std::nullopt;
}
Change ReadCreateThread(JsonMembers& m) {
  AddThread change{m.NeedText("path")};
  change.options.activation = OneOf<ThreadOptions::Activation>(m, "activation", ActivationNames());
  change.options.period = PeriodIn(m).value_or(change.options.period);
  change.options.priority = PriorityIn(m).value_or(0);
  return change;
}
Change ReadSchedule(JsonMembers& m) {
  ScheduleThread change{.thread = m.NeedText("path"), .period = PeriodIn(m), .priority = PriorityIn(m)};
  if (m.Find("activation") != nullptr) {
    change.activation = OneOf<ThreadOptions::Activation>(m, "activation", ActivationNames());
  }
  return change;
}

struct Kind {
  std::string_view name;
  Change (*read)(JsonMembers& m);
};
constexpr Kind kKinds[] = {
    {"create",
     [](JsonMembers& m) -> Change {
       return CreateModule{m.NeedText("path"), m.NeedText("type"), SettingsIn(m)};
     }},
    {"create_group", [](JsonMembers& m) -> Change { return CreateGroup{m.NeedText("path")}; }},
    {"create_port",
     [](JsonMembers& m) -> Change {
       return CreatePort{m.NeedText("path"), OneOf<Port::Direction>(m, "direction", kDirectionNames),
                         m.NeedText("type"), m.Text("description").value_or("")};
     }},
    {"create_parameter",
     [](JsonMembers& m) -> Change {
       return CreateParameter{m.NeedText("path"), m.NeedTexts("targets"), m.Text("description").value_or("")};
     }},
    {"delete", [](JsonMembers& m) -> Change { return DeleteElement{m.NeedText("path")}; }},
    {"connect", ReadConnect},
    {"disconnect",
     [](JsonMembers& m) -> Change {
       return DisconnectPorts{m.NeedText("from"), m.NeedText("to")};
     }},
    {"set",
     [](JsonMembers& m) -> Change {
       return SetParameter{m.NeedText("path"), m.NeedText("value")};
     }},
    {"replace", ReadReplace},
    {"move",
     [](JsonMembers& m) -> Change {
       return AssignToThread{m.NeedText("path"), m.NeedText("thread")};
     }},
    {"rename",
     [](JsonMembers& m) -> Change {
       return RenameElement{m.NeedText("path"), m.NeedText("name")};
     }},
    {"tag",
     [](JsonMembers& m) -> Change {
       return TagElement{m.NeedText("path"), TagsInText(m.NeedText("tags"))};
     }},
    {"log", ReadLog},
    {"copy",
     [](JsonMembers& m) -> Change {
       return CopyElement{m.NeedText("path"), m.Text("name").value_or("")};
     }},
    {"offer",
     [](JsonMembers& m) -> Change {
       return ExtensionChange{"offer", m.NeedTexts("words"), SettingsIn(m)};
     }},
    {"take",
     [](JsonMembers& m) -> Change {
       return ExtensionChange{"take", m.NeedTexts("words"), SettingsIn(m)};
     }},
    {"create_thread", ReadCreateThread},
    {"schedule", ReadSchedule}};

}  // namespace

Result<Change> ParseChange(const JsonPart& json) {
  if (!json.is_object()) return Error{.message = "a change must be an object"};
  JsonMembers members(json);
  const JsonPart* const named = members.Find("change");
  const auto name = named != nullptr ? named->text() : std::nullopt;
  if (!name) return Error{.message = "\"change\" must be a text that says what to do"};
  const Kind* const kind = std::ranges::find(kKinds, *name, &Kind::name);
  if (kind == std::end(kKinds)) {
    return Error{.message = "there is no change '" + *name + "'",
                 .hint = NearestNameHint(*name, NamesOf(kKinds, &Kind::name))};
  }
  Change change = kind->read(members);
  members.RefuseOthers();
  if (!members.error()) return change;
  return members.error()->WithContext("'" + *name + "'");
}

}  // namespace runnel::internal
