#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "plugins/values/json_reader.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

struct SubscribeMessage {
  struct Item {
    std::uint32_t id;
    std::uint32_t channel;
  };
  std::vector<Item> subscriptions;
};
struct UnsubscribeMessage {
  std::vector<std::uint32_t> ids;
};
/// Of other topics than the STOP it takes kDrive besides.
struct AdvertiseMessage {
  struct Channel {
    std::uint32_t id;
    std::string topic;
    std::string encoding;
  };
  std::vector<Channel> channels;
};
struct UnadvertiseMessage {
  std::vector<std::uint32_t> ids;
};
struct GetParametersMessage {
  std::vector<std::string> names;  ///< none: all
  std::optional<std::string> id;
};
struct SetParametersMessage {
  struct Item {
    std::string name;
    std::optional<JsonPart> value;
    std::string type;  ///< "byte_array", "float64", "float64_array" or ""
  };
  std::vector<Item> parameters;
  std::optional<std::string> id;
};
struct SubscribeParametersMessage {
  std::vector<std::string> names;  ///< none: all
  bool is_wanted;
};
struct SubscribeGraphMessage {
  bool is_wanted;
};

using ClientSaid =
    std::variant<SubscribeMessage, UnsubscribeMessage, AdvertiseMessage, UnadvertiseMessage, GetParametersMessage,
                 SetParametersMessage, SubscribeParametersMessage, SubscribeGraphMessage>;
/// What a client says in text.
struct ClientMessage {
  std::string_view op;
  WebRole role;  ///< that is needed for it
  ClientSaid said;
};

/// What a client says in binary to call a service.
struct ServiceCallMessage {
  std::uint32_t service;
  std::uint32_t call;
  std::string encoding;
  std::string payload;
};
/// Of a message whose first byte is 2. Errors: it is too short for what it says.
[[nodiscard]] Result<ServiceCallMessage> ReadServiceCall(std::string_view message);
/// Four bytes, the least first, from `at` on. Precondition: they are there.
[[nodiscard]] std::uint32_t ReadNumber(std::string_view bytes, std::size_t at);

/// Errors: no JSON, no such operation, fields that are missing or of a wrong kind.
[[nodiscard]] Result<ClientMessage> ParseClientMessage(std::string_view text);

}  // namespace runnel::internal
