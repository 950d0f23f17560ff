#include "plugins/foxglove/internal/client_message.h"

#include <array>
#include <limits>

#include <nlohmann/json.hpp>

#include "core/base/nearest_name.h"

namespace runnel::internal {

namespace {

using Json = nlohmann::json;

/// What is wrong with the shape of a message; caught where messages are parsed.
struct ParseError {
  Error error;
};

[[noreturn]] void Refuse(const std::string& op, const std::string& what) {
  throw ParseError{{.message = op + ": " + what}};
}

const Json& FieldOf(const std::string& op, const Json& object, const char* name) {
  if (!object.is_object()) Refuse(op, "expected an object with '" + std::string(name) + "'");
  const auto found = object.find(name);
  if (found == object.end()) Refuse(op, "'" + std::string(name) + "' is missing");
  return *found;
}

const Json& ListOf(const std::string& op, const Json& object, const char* name) {
  const Json& list = FieldOf(op, object, name);
  if (!list.is_array()) Refuse(op, "'" + std::string(name) + "' is no list");
  return list;
}

std::string TextOf(const std::string& op, const Json& object, const char* name) {
  const Json& text = FieldOf(op, object, name);
  if (!text.is_string()) Refuse(op, "'" + std::string(name) + "' is no text");
  return text.get<std::string>();
}

std::optional<std::string> PerhapsText(const std::string& op, const Json& object,
                                       const char* name) {
  if (!object.contains(name) || object.at(name).is_null()) return std::nullopt;
  return TextOf(op, object, name);
}

std::uint32_t NumberIn(const std::string& op, const Json& number, const char* what) {
  if (!number.is_number_unsigned() ||
      number.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    Refuse(op, std::string(what) + " is a whole number from 0 to 4294967295");
  }
  return number.get<std::uint32_t>();
}

std::vector<std::uint32_t> NumbersOf(const std::string& op, const Json& object, const char* name) {
  std::vector<std::uint32_t> numbers;
  for (const Json& each : ListOf(op, object, name)) numbers.push_back(NumberIn(op, each, "an id"));
  return numbers;
}

std::vector<std::string> NamesOf(const std::string& op, const Json& object) {
  std::vector<std::string> names;
  for (const Json& each : ListOf(op, object, "parameterNames")) {
    if (!each.is_string()) Refuse(op, "a parameter's name is a text");
    names.push_back(each.get<std::string>());
  }
  return names;
}

ClientMessage ParseSubscribe(const std::string& op, const Json& json) {
  SubscribeMessage message;
  for (const Json& each : ListOf(op, json, "subscriptions")) {
    message.subscriptions.push_back({NumberIn(op, FieldOf(op, each, "id"), "'id'"),
                                     NumberIn(op, FieldOf(op, each, "channelId"), "'channelId'")});
  }
  return message;
}
ClientMessage ParseUnsubscribe(const std::string& op, const Json& json) {
  return UnsubscribeMessage{NumbersOf(op, json, "subscriptionIds")};
}
ClientMessage ParseAdvertise(const std::string& op, const Json& json) {
  AdvertiseMessage message;
  for (const Json& each : ListOf(op, json, "channels")) {
    message.channels.push_back({NumberIn(op, FieldOf(op, each, "id"), "'id'"),
                                TextOf(op, each, "topic"), TextOf(op, each, "encoding")});
  }
  return message;
}
ClientMessage ParseUnadvertise(const std::string& op, const Json& json) {
  return UnadvertiseMessage{NumbersOf(op, json, "channelIds")};
}
ClientMessage ParseGetParameters(const std::string& op, const Json& json) {
  return GetParametersMessage{NamesOf(op, json), PerhapsText(op, json, "id")};
}
ClientMessage ParseSetParameters(const std::string& op, const Json& json) {
  SetParametersMessage message{{}, PerhapsText(op, json, "id")};
  for (const Json& each : ListOf(op, json, "parameters")) {
    SetParametersMessage::Item item{TextOf(op, each, "name"), "", std::nullopt,
                                    PerhapsText(op, each, "type").value_or("")};
    if (const auto value = each.find("value"); value != each.end()) {
      item.json = value->dump();
      if (value->is_string()) item.text = value->get<std::string>();
    }
    message.parameters.push_back(std::move(item));
  }
  return message;
}
ClientMessage ParseSubscribeParameters(const std::string& op, const Json& json) {
  return SubscribeParametersMessage{NamesOf(op, json), true};
}
ClientMessage ParseUnsubscribeParameters(const std::string& op, const Json& json) {
  return SubscribeParametersMessage{NamesOf(op, json), false};
}
ClientMessage ParseSubscribeGraph(const std::string&, const Json&) {
  return SubscribeGraphMessage{true};
}
ClientMessage ParseUnsubscribeGraph(const std::string&, const Json&) {
  return SubscribeGraphMessage{false};
}

struct Operation {
  std::string_view name;
  ClientMessage (*parse)(const std::string& op, const Json& json);
};
constexpr std::array<Operation, 10> kOperations{{
    {"subscribe", ParseSubscribe},
    {"unsubscribe", ParseUnsubscribe},
    {"advertise", ParseAdvertise},
    {"unadvertise", ParseUnadvertise},
    {"getParameters", ParseGetParameters},
    {"setParameters", ParseSetParameters},
    {"subscribeParameterUpdates", ParseSubscribeParameters},
    {"unsubscribeParameterUpdates", ParseUnsubscribeParameters},
    {"subscribeConnectionGraph", ParseSubscribeGraph},
    {"unsubscribeConnectionGraph", ParseUnsubscribeGraph},
}};

Error NoSuchOperation(const std::string& op) {
  std::vector<std::string> names;
  for (const Operation& each : kOperations) names.emplace_back(each.name);
  return {.message = "there is no operation '" + op + "' here", .hint = NearestNameHint(op, names)};
}

}  // namespace

Result<ClientMessage> ParseClientMessage(std::string_view text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return Error{.message = "this message is no JSON"};
  if (!json.is_object() || !json.contains("op") || !json.at("op").is_string()) {
    return Error{.message = "a message is a JSON object with an \"op\""};
  }
  const std::string op = json.at("op").get<std::string>();
  for (const Operation& each : kOperations) {
    if (each.name != op) continue;
    try {
      return each.parse(op, json);
    } catch (const ParseError& parse_error) {
      return parse_error.error;
    }
  }
  return NoSuchOperation(op);
}

}  // namespace runnel::internal
