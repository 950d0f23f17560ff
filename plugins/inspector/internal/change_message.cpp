#include "plugins/inspector/internal/change_message.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"

namespace runnel::internal {

namespace {

constexpr std::array<std::pair<const char*, OnFull>, 3> kOnFull{
    {{"drop_oldest", OnFull::kDropOldest},
     {"drop_newest", OnFull::kDropNewest},
     {"refuse", OnFull::kRefuse}}};
constexpr std::array<std::pair<const char*, Port::Direction>, 2> kDirections{
    {{"input", Port::Direction::kInput}, {"output", Port::Direction::kOutput}}};
constexpr std::uint64_t kLargestCount = 1'000'000'000;

template <typename T, std::size_t size>
T OneOf(JsonMembers& members, const std::string& key,
        const std::array<std::pair<const char*, T>, size>& words, T otherwise) {
  const auto word = members.Text(key);
  if (!word) return otherwise;
  std::vector<std::string> names;
  for (const auto& [name, value] : words) {
    if (*word == name) return value;
    names.emplace_back(name);
  }
  members.Complain("\"" + key + "\" cannot be '" + *word + "'", NearestNameHint(*word, names));
  return otherwise;
}

bool IsTrue(JsonMembers& members, const std::string& key) {
  const JsonPart* const found = members.Find(key);
  if (found == nullptr || found->is_null()) return false;
  const bool is_true = found->json() == "true";
  if (!is_true && found->json() != "false") {
    members.Complain("\"" + key + "\" must be true or false");
  }
  return is_true;
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

Change ReadCreate(JsonMembers& m) {
  return CreateModule{m.NeedText("path"), m.NeedText("type"), SettingsIn(m)};
}
Change ReadCreateGroup(JsonMembers& m) { return CreateGroup{m.NeedText("path")}; }
Change ReadCreatePort(JsonMembers& m) {
  return CreatePort{m.NeedText("path"), OneOf(m, "direction", kDirections, Port::Direction::kInput),
                    m.NeedText("type"), m.Text("description").value_or("")};
}
Change ReadDelete(JsonMembers& m) { return DeleteElement{m.NeedText("path")}; }
Change ReadConnect(JsonMembers& m) {
  return ConnectPorts{m.NeedText("from"),
                      m.NeedText("to"),
                      {.queue = m.Count("queue", kLargestCount).value_or(0),
                       .on_full = OneOf(m, "on_full", kOnFull, OnFull::kDropOldest),
                       .pull = IsTrue(m, "pull")}};
}
Change ReadDisconnect(JsonMembers& m) {
  return DisconnectPorts{m.NeedText("from"), m.NeedText("to")};
}
Change ReadSet(JsonMembers& m) { return SetParameter{m.NeedText("path"), m.NeedText("value")}; }
Change ReadReplace(JsonMembers& m) {
  ReplaceModule change{m.NeedText("path"), m.NeedText("type"), SettingsIn(m)};
  change.probation_cycles = m.Count("probation", kLargestCount).value_or(change.probation_cycles);
  return change;
}
Change ReadMove(JsonMembers& m) { return AssignToThread{m.NeedText("path"), m.NeedText("thread")}; }

struct Kind {
  std::string_view name;
  Change (*read)(JsonMembers& members);
};
constexpr std::array<Kind, 9> kKinds{{{"create", ReadCreate},
                                      {"create_group", ReadCreateGroup},
                                      {"create_port", ReadCreatePort},
                                      {"delete", ReadDelete},
                                      {"connect", ReadConnect},
                                      {"disconnect", ReadDisconnect},
                                      {"set", ReadSet},
                                      {"replace", ReadReplace},
                                      {"move", ReadMove}}};

}  // namespace

Result<Change> ParseChange(const JsonPart& json) {
  if (!json.is_object()) return Error{.message = "a change must be an object"};
  JsonMembers members(json);
  const JsonPart* const named = members.Find("change");
  const auto name = named != nullptr ? named->text() : std::nullopt;
  if (!name) return Error{.message = "\"change\" must be a text that says what to do"};
  const auto kind = std::ranges::find(kKinds, *name, &Kind::name);
  if (kind == kKinds.end()) {
    std::vector<std::string> names;
    for (const Kind& each : kKinds) names.emplace_back(each.name);
    return Error{.message = "there is no change '" + *name + "'",
                 .hint = NearestNameHint(*name, names)};
  }
  Change change = kind->read(members);
  members.RefuseOthers();
  if (!members.error()) return change;
  Error error = *members.error();
  error.message = "of '" + *name + "', " + error.message;
  return error;
}

}  // namespace runnel::internal
