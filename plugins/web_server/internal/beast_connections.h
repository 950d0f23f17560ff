#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "plugins/web_server/internal/connection_registry.h"

namespace runnel::internal {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// Serves one connection that has been accepted, until it ends or becomes a session. `user`: whose process of this
/// machine is at the other end, if the rules ask for that and the system says.
void ServeHttp(ConnectionRegistry& registry, boost::asio::ip::tcp::socket socket,
               std::optional<std::uint32_t> user);

/// Goes on with a connection whose request for a WebSocket has been granted. `name`: of the protocol,
/// as it is answered. `role`: what the client may do.
void ServeWebSocket(ConnectionRegistry& registry, boost::asio::ip::tcp::socket socket,
                    HttpRequest request, const WebProtocol& protocol, std::string name,
                    WebRole role);

}  // namespace runnel::internal
