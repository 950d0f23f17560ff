#include "plugins/inspector/internal/change_message.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/nearest_name.h"

namespace runnel::internal {

namespace {

using Json = nlohmann::json;

constexpr std::array<std::pair<const char*, OnFull>, 3> kOnFull{
    {{"drop_oldest", OnFull::kDropOldest},
     {"drop_newest", OnFull::kDropNewest},
     {"refuse", OnFull::kRefuse}}};
constexpr std::array<std::pair<const char*, Port::Direction>, 2> kDirections{
    {{"input", Port::Direction::kInput}, {"output", Port::Direction::kOutput}}};
constexpr std::uint64_t kLargestCount = 1'000'000'000;

/// Takes members out of an object; remembers the first error, and which members there may be.
class Members {
 public:
  explicit Members(const Json& json) : json_(json) {}

  std::string Text(const char* key) {
    std::string text = TextOr(key, "");
    if (!json_.contains(key)) Complain("\"" + std::string(key) + "\" is missing");
    return text;
  }
  std::string TextOr(const char* key, std::string otherwise) {
    const Json* const found = Find(key);
    if (found == nullptr) return otherwise;
    if (found->is_string()) return found->get<std::string>();
    Complain("\"" + std::string(key) + "\" must be a text");
    return otherwise;
  }
  std::uint64_t CountOr(const char* key, std::uint64_t otherwise) {
    const Json* const found = Find(key);
    if (found == nullptr) return otherwise;
    if (found->is_number_unsigned() && found->get<std::uint64_t>() <= kLargestCount) {
      return found->get<std::uint64_t>();
    }
    Complain("\"" + std::string(key) + "\" must be a count, at most 1000000000");
    return otherwise;
  }
  template <typename T, std::size_t size>
  T OneOf(const char* key, const std::array<std::pair<const char*, T>, size>& words, T otherwise) {
    if (!json_.contains(key)) return otherwise;
    const std::string word = Text(key);
    std::vector<std::string> names;
    for (const auto& [name, value] : words) {
      if (word == name) return value;
      names.emplace_back(name);
    }
    Complain("\"" + std::string(key) + "\" cannot be '" + word + "'", NearestNameHint(word, names));
    return otherwise;
  }
  /// {"step": "0.1"}: values of parameters in their text format.
  std::vector<Setting> Settings() {
    std::vector<Setting> settings;
    const Json* const found = Find("settings");
    if (found == nullptr) return settings;
    if (!found->is_object()) {
      Complain("\"settings\" must be an object");
      return settings;
    }
    for (const auto& [name, value] : found->items()) {
      if (!value.is_string()) {
        Complain("the setting '" + name + "' must be a text");
      } else {
        settings.push_back({name, value.get<std::string>()});
      }
    }
    return settings;
  }
  /// The first error; what has not been asked for is one.
  [[nodiscard]] std::optional<Error> Finish() {
    for (const auto& [name, value] : json_.items()) {
      if (std::ranges::find(known_, name) == known_.end()) {
        Complain("has no \"" + name + "\"", NearestNameHint(name, known_));
      }
    }
    return error_;
  }

 private:
  const Json* Find(const char* key) {
    known_.emplace_back(key);
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }
  void Complain(std::string message, std::string hint = {}) {
    if (!error_) error_ = Error{.message = std::move(message), .hint = std::move(hint)};
  }

  const Json& json_;
  std::vector<std::string> known_{"change"};
  std::optional<Error> error_;
};

struct Kind {
  std::string name;
  std::function<Change(Members&)> read;
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds{
      {"create",
       [](Members& m) -> Change {
         return CreateModule{m.Text("path"), m.Text("type"), m.Settings()};
       }},
      {"create_group", [](Members& m) -> Change { return CreateGroup{m.Text("path")}; }},
      {"create_port",
       [](Members& m) -> Change {
         return CreatePort{m.Text("path"),
                           m.OneOf("direction", kDirections, Port::Direction::kInput),
                           m.Text("type"), m.TextOr("description", "")};
       }},
      {"delete", [](Members& m) -> Change { return DeleteElement{m.Text("path")}; }},
      {"connect",
       [](Members& m) -> Change {
         return ConnectPorts{m.Text("from"),
                             m.Text("to"),
                             {.queue = m.CountOr("queue", 0),
                              .on_full = m.OneOf("on_full", kOnFull, OnFull::kDropOldest)}};
       }},
      {"disconnect",
       [](Members& m) -> Change {
         return DisconnectPorts{m.Text("from"), m.Text("to")};
       }},
      {"set",
       [](Members& m) -> Change {
         return SetParameter{m.Text("path"), m.Text("value")};
       }},
      {"replace",
       [](Members& m) -> Change {
         ReplaceModule change{m.Text("path"), m.Text("type"), m.Settings()};
         change.probation_cycles = m.CountOr("probation", change.probation_cycles);
         return change;
       }},
      {"move",
       [](Members& m) -> Change {
         return AssignToThread{m.Text("path"), m.Text("thread")};
       }},
  };
  return kinds;
}

}  // namespace

Result<Change> ParseChange(const Json& json) {
  if (!json.is_object()) return Error{.message = "a change must be an object"};
  const auto named = json.find("change");
  if (named == json.end() || !named->is_string()) {
    return Error{.message = "\"change\" must be a text that says what to do"};
  }
  const std::string name = named->get<std::string>();
  const auto kind = std::ranges::find(Kinds(), name, &Kind::name);
  if (kind == Kinds().end()) {
    std::vector<std::string> names;
    for (const Kind& each : Kinds()) names.push_back(each.name);
    return Error{.message = "there is no change '" + name + "'",
                 .hint = NearestNameHint(name, names)};
  }
  Members members(json);
  Change change = kind->read(members);
  if (auto error = members.Finish()) {
    error->message = "of '" + name + "', " + error->message;
    return *error;
  }
  return change;
}

}  // namespace runnel::internal
