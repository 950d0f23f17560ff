#include "plugins/foxglove/internal/parameter_handler.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/types/type_of.h"
#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/foxglove/internal/server_messages.h"
#include "plugins/values/json_values.h"
#include "plugins/values/json_writer.h"
#include "plugins/values/value_bytes.h"

namespace runnel::internal {

namespace {

constexpr auto kBetweenLooksAtValues = std::chrono::milliseconds(250);
constexpr auto kSoonAgain = std::chrono::milliseconds(5);
constexpr auto kLongTime = std::chrono::hours(1);
constexpr std::size_t kMostWaiting = 100;  // requests of one client
constexpr std::size_t kMostAtOnce = 1000;

}  // namespace

struct ParameterHandler::PendingSet {
  SetParametersMessage message;
  RobotStop::AsOf as_of;
  bool has_begun = false;
  // One for each parameter: what is wrong with one is no reason to leave out the others.
  std::vector<std::unique_ptr<PendingCommand>> changes = {};
  std::vector<Error> errors = {};
};

std::vector<std::string> ParameterHandler::AllNames() const {
  return NamesOf(shared_.directory.content()->parameters, [](const auto& each) { return each.first; });
}

void ParameterHandler::SendError(const Error& error) {
  send_queue_.Send(StatusMessage(StatusLevel::kError, error.ToString()));
}

Error ParameterHandler::NoSuchParameter(const std::string& name, bool& may_search) const {
  Error error{.message = "there is no parameter '" + name + "'"};
  if (std::exchange(may_search, false)) error.hint = NearestNameHint(name, AllNames());
  return error;
}

void ParameterHandler::Get(const GetParametersMessage& message) {
  if (gets_.size() >= kMostWaiting) {
    return SendError({.message = "getParameters: too many requests are waiting"});
  }
  gets_.push_back(message);
}

void ParameterHandler::Set(const SetParametersMessage& message) {
  if (sets_.size() >= kMostWaiting) {
    return SendError({.message = "setParameters: too many requests are waiting"});
  }
  if (message.parameters.size() > kMostAtOnce) {
    return SendError({.message = "setParameters: more than " + std::to_string(kMostAtOnce) + " parameters at once"});
  }
  sets_.push_back(std::make_shared<PendingSet>(PendingSet{message, shared_.runtime().robot_stop().AsOfNow()}));
}

void ParameterHandler::Subscribe(const SubscribeParametersMessage& message) {
  const auto known = AllNames();
  if (message.names.empty()) {
    subscribed_.clear();
    if (message.is_wanted) subscribed_.insert(known.begin(), known.end());
  }
  bool may_search = true;
  for (const std::string& name : message.names) {
    if (!message.is_wanted) {
      subscribed_.erase(name);
    } else if (std::ranges::binary_search(known, name)) {
      subscribed_.insert(name);
    } else if (!send_queue_.is_long()) {
      SendError(NoSuchParameter(name, may_search));
    }
  }
  std::erase_if(told_, [&](const auto& each) { return !subscribed_.contains(each.first); });
  look_at_ = {};
}

ParameterHandler::SteadyTime ParameterHandler::Continue(SteadyTime now) {
  if (send_queue_.is_long()) return now + kSoonAgain;
  const bool has_answered = AnswerGets();
  const bool has_set = ContinueSets();
  if (!subscribed_.empty() && now >= look_at_) {
    look_at_ = now + kBetweenLooksAtValues;
    SendChanges();
  }
  if (!has_answered || !has_set) return now + kSoonAgain;
  return subscribed_.empty() ? now + kLongTime : look_at_;
}

std::optional<ParameterHandler::Values> ParameterHandler::Read(const std::vector<std::string>& names) const {
  Values values;
  const auto add = [&](std::size_t i, const DirectoryParameter* parameter) {
    if (parameter != nullptr) values[names[i]] = ParameterJson(names[i], *parameter->element);
  };
  if (!shared_.directory.VisitParameters(names, add)) return std::nullopt;
  return values;
}

void ParameterHandler::SendValues(const Values& values, const std::optional<std::string>& id) {
  send_queue_.Send(JsonObjectText([&](JsonObject& message) {
    message.Add("op", "parameterValues");
    AppendList(values, message.Key("parameters"), [](const auto& each, std::string& json) { json += each.second; });
    if (id) message.Add("id", *id);
  }));
}

// False if something is still to be answered.
bool ParameterHandler::AnswerGets() {
  while (!gets_.empty()) {
    const GetParametersMessage& get = gets_.front();
    const auto values = Read(get.names.empty() ? AllNames() : get.names);
    if (!values) return false;
    bool may_search = true;
    for (const std::string& name : get.names) {
      if (!values->contains(name) && !send_queue_.is_long()) {
        SendError(NoSuchParameter(name, may_search));
      }
    }
    SendValues(*values, get.id);
    gets_.pop_front();
  }
  return true;
}

bool ParameterHandler::ContinueSets() {
  while (!sets_.empty()) {
    PendingSet& set = *sets_.front();
    if (!set.has_begun && !BeginSet(set)) return false;
    // The worker tells when it is.
    if (!std::ranges::all_of(set.changes, [](const auto& each) { return each->is_done(); })) {
      return true;
    }
    // What they are now, whatever has come of it.
    if (set.message.id) {
      const auto values = Read(NamesOf(set.message.parameters, &SetParametersMessage::Item::name));
      if (!values) return false;
      SendValues(*values, set.message.id);
    }
    for (const auto& change : set.changes) {
      const CommandAnswer answer = change->Take();
      const auto& errors = answer.diagnostics.errors();
      if (!answer && !errors.empty()) set.errors.push_back(errors.front());
    }
    for (const Error& error : set.errors) {
      if (!send_queue_.is_long()) SendError(error);
    }
    sets_.pop_front();
    look_at_ = {};
  }
  return true;
}

// False if the structure is locked.
bool ParameterHandler::BeginSet(PendingSet& set) {
  bool may_search = true;
  set.has_begun = shared_.directory.VisitParameters(
      NamesOf(set.message.parameters, &SetParametersMessage::Item::name),
      [&](std::size_t i, const DirectoryParameter* parameter) {
        const SetParametersMessage::Item& item = set.message.parameters[i];
        if (parameter == nullptr) {
          set.errors.push_back(NoSuchParameter(item.name, may_search));
          return;
        }
        auto setting = SettingOf(item, parameter->path, *parameter->element);
        if (!setting) {
          set.errors.push_back(setting.error());
          set.errors.back().path = parameter->path;
          return;
        }
        set.changes.push_back(shared_.application.service.Begin(
            ChangeRequest{{.changes = {std::move(*setting)}, .positions = {}}, {}, "Foxglove"}, *shared_.tasks, wake_,
            set.as_of));
      });
  return set.has_begun;
}

void ParameterHandler::SendChanges() {
  auto values = Read({subscribed_.begin(), subscribed_.end()});
  if (!values) {
    look_at_ = {};
    return;
  }
  Values changed;
  for (const auto& [name, value] : *values) {
    const auto before = told_.find(name);
    if (before == told_.end() || before->second != value) changed[name] = value;
  }
  told_ = std::move(*values);
  if (!changed.empty()) SendValues(changed, std::nullopt);
}

namespace {

bool IsListOf(const TypeInfo& type, const TypeInfo& element) {
  return type.kind() == TypeKind::kSequence && type.elements().type == &element;
}
bool IsBytes(const TypeInfo& type) { return IsListOf(type, TypeOf<std::uint8_t>()); }

// What the protocol calls it; "" for what has no name there.
const char* KindOf(const TypeInfo& type) {
  if (IsBytes(type)) return "byte_array";
  if (&type == &TypeOf<double>() || &type == &TypeOf<float>()) return "float64";
  const bool is_list = IsListOf(type, TypeOf<double>()) || IsListOf(type, TypeOf<float>());
  return is_list ? "float64_array" : "";
}

// Whether people had rather read and write the text format: "20ms", not {"sec":0,"nsec":20000000}.
bool IsShownAsText(const TypeInfo& type, const std::string& json) {
  if (type.kind() == TypeKind::kEnumeration) return true;
  return type.kind() == TypeKind::kLeaf && (json.starts_with('"') || json.starts_with('{'));
}

std::string ValueJson(const Configurable& parameter) {
  const TypeInfo& type = parameter.type();
  const std::shared_ptr<void> value = parameter.Value();
  std::string json;
  if (IsBytes(type)) {
    AppendBase64(type, value.get(), json);
    return json;
  }
  if (type.is_transparent()) AppendJson(type, value.get(), json, {.has_infinity = false});
  if (!json.empty() && !IsShownAsText(type, json)) return json;
  json.clear();
  AppendJsonString(ToText(type, value.get()), json);
  return json;
}

Result<SetParameter> SettingOfBytes(const SetParametersMessage::Item& item, const std::string& path,
                                    const TypeInfo& type) {
  const auto text = item.value->text();
  const auto bytes = text ? FromBase64(*text) : std::nullopt;
  if (!bytes) return Error{.message = "the value of a byte_array is a text in base64"};
  if (!IsBytes(type)) return Error{.message = "a " + type.name() + " is no list of bytes"};
  const std::shared_ptr<void> list = type.Make();
  if (!type.elements().resize(list.get(), 1, bytes->size())) {
    return Error{.message = std::to_string(bytes->size()) + " bytes are no " + type.name()};
  }
  for (std::size_t i = 0; i < bytes->size(); ++i) {
    std::memcpy(type.elements().element(list.get(), i), &(*bytes)[i], 1);
  }
  return SetParameter{path, "", list, &type};
}

}  // namespace

std::string ParameterJson(const std::string& name, const Configurable& parameter) {
  std::string value;
  const char* kind = "";
  try {
    value = ValueJson(parameter);
    // Numbers that are none are null, which no type of the protocol allows.
    if (value.find("null") == std::string::npos) kind = KindOf(parameter.type());
  } catch (...) {
    AppendJsonString("(" + DescribeException() + ")", value);
  }
  return JsonObjectText([&](JsonObject& object) {
    object.Add("name", name).AddJson("value", value);
    if (*kind != '\0') object.Add("type", kind);
  });
}

Result<SetParameter> SettingOf(const SetParametersMessage::Item& item, const std::string& path,
                               const Configurable& parameter) {
  const TypeInfo& type = parameter.type();
  if (!item.value) {
    return Error{.message = "a parameter cannot be removed, only set", .hint = "say its \"value\""};
  }
  if (item.type == "byte_array") return SettingOfBytes(item, path, type);
  if (const auto text = item.value->text()) return SetParameter{path, *text};
  if (!type.is_transparent()) {
    return Error{.message = "a " + type.name() + " can be set as text only"};
  }
  const std::shared_ptr<void> value = parameter.Value();
  if (auto set = SetFromJson(type, *item.value, value.get()); !set) return set.error();
  return SetParameter{path, "", value, &type};
}

}  // namespace runnel::internal
