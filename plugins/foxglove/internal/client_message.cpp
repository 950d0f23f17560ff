#include "plugins/foxglove/internal/client_message.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/base/nearest_name.h"

namespace runnel::internal {

namespace {

constexpr std::uint64_t kLargestId = std::numeric_limits<std::uint32_t>::max();

std::uint32_t IdIn(JsonMembers& members, const std::string& name) {
  return static_cast<std::uint32_t>(members.NeedCount(name, kLargestId));
}

std::vector<std::uint32_t> IdsIn(JsonMembers& members, const std::string& name) {
  std::vector<std::uint32_t> ids;
  for (const JsonPart& each : members.NeedList(name)) {
    const auto id = each.count();
    if (!id || *id > kLargestId) members.Complain("\"" + name + "\" must be a list of ids");
    ids.push_back(static_cast<std::uint32_t>(id.value_or(0)));
  }
  return ids;
}

std::vector<std::string> NamesIn(JsonMembers& members) { return members.NeedTexts("parameterNames"); }

// What `read` makes of each object of a list.
template <typename Read>
auto ItemsIn(JsonMembers& members, const std::string& name, const Read& read) {
  std::vector<decltype(read(members))> items;
  for (const JsonPart& each : members.NeedList(name)) {
    JsonMembers item(each);
    items.push_back(read(item));
    item.RefuseOthers();
    if (item.error()) members.Complain(item.error()->message);
  }
  return items;
}

ClientSaid ReadSubscribe(JsonMembers& members) {
  return SubscribeMessage{ItemsIn(members, "subscriptions", [](JsonMembers& item) {
    return SubscribeMessage::Item{IdIn(item, "id"), IdIn(item, "channelId")};
  })};
}
ClientSaid ReadAdvertise(JsonMembers& members) {
  return AdvertiseMessage{ItemsIn(members, "channels", [](JsonMembers& item) {
    for (const char* each : {"schemaName", "schemaEncoding", "schema"}) (void)item.Find(each);  // the input knows it
    return AdvertiseMessage::Channel{IdIn(item, "id"), item.NeedText("topic"), item.NeedText("encoding")};
  })};
}
ClientSaid ReadSetParameters(JsonMembers& members) {
  auto items = ItemsIn(members, "parameters", [](JsonMembers& item) {
    const JsonPart* const value = item.Find("value");
    return SetParametersMessage::Item{item.NeedText("name"), value != nullptr ? std::optional(*value) : std::nullopt,
                                      item.Text("type").value_or("")};
  });
  return SetParametersMessage{std::move(items), members.Text("id")};
}

struct Operation {
  std::string_view name;
  WebRole role;
  ClientSaid (*read)(JsonMembers& members);
};
using enum WebRole;
constexpr std::array<Operation, 10> kOperations{{
    {"subscribe", kLook, ReadSubscribe},
    {"unsubscribe", kLook,
     [](JsonMembers& m) -> ClientSaid { return UnsubscribeMessage{IdsIn(m, "subscriptionIds")}; }},
    {"advertise", kLook, ReadAdvertise},
    {"unadvertise", kLook, [](JsonMembers& m) -> ClientSaid { return UnadvertiseMessage{IdsIn(m, "channelIds")}; }},
    {"getParameters", kLook,
     [](JsonMembers& m) -> ClientSaid {
       return GetParametersMessage{NamesIn(m), m.Text("id")};
     }},
    {"setParameters", kChange, ReadSetParameters},
    {"subscribeParameterUpdates", kLook,
     [](JsonMembers& m) -> ClientSaid {
       return SubscribeParametersMessage{NamesIn(m), true};
     }},
    {"unsubscribeParameterUpdates", kLook,
     [](JsonMembers& m) -> ClientSaid {
       return SubscribeParametersMessage{NamesIn(m), false};
     }},
    {"subscribeConnectionGraph", kLook, [](JsonMembers&) -> ClientSaid { return SubscribeGraphMessage{true}; }},
    {"unsubscribeConnectionGraph", kLook, [](JsonMembers&) -> ClientSaid { return SubscribeGraphMessage{false}; }},
}};

}  // namespace

std::uint32_t ReadNumber(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return number;
}

Result<ServiceCallMessage> ReadServiceCall(std::string_view message) {
  constexpr std::size_t kHead = 13;
  if (message.size() < kHead || message.size() - kHead < ReadNumber(message, 9)) {
    return Error{.message = "a call of a service is shorter than it says"};
  }
  const std::size_t encoding = ReadNumber(message, 9);
  return ServiceCallMessage{ReadNumber(message, 1), ReadNumber(message, 5),
                            std::string(message.substr(kHead, encoding)),
                            std::string(message.substr(kHead + encoding))};
}

Result<ClientMessage> ParseClientMessage(std::string_view text) {
  const auto json = JsonPart::Parse(text);
  if (!json) return Error{.message = "this message is no JSON"};
  JsonMembers members(*json);
  const auto op = members.Text("op");
  if (!op) return Error{.message = "a message is a JSON object with an \"op\""};
  const auto operation = std::ranges::find(kOperations, *op, &Operation::name);
  if (operation == kOperations.end()) {
    return Error{.message = "there is no operation '" + *op + "' here",
                 .hint = NearestNameHint(*op, NamesOf(kOperations, &Operation::name))};
  }
  ClientMessage message{operation->name, operation->role, operation->read(members)};
  members.RefuseOthers();
  if (!members.error()) return message;
  return members.error()->WithContext(*op);
}

}  // namespace runnel::internal
