#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/tags.h"
#include "plugins/inspector/internal/viewer_message.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::internal {

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
