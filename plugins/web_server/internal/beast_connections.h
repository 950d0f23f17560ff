#pragma once

#include <string>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "plugins/web_server/internal/connection_registry.h"

namespace runnel::internal {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// Serves one connection that has been accepted, until it ends or becomes a session.
void ServeHttp(ConnectionRegistry& registry, boost::asio::ip::tcp::socket socket);

/// Goes on with a connection whose request for a WebSocket has been granted. `name`: of the protocol,
/// as it is answered.
void ServeWebSocket(ConnectionRegistry& registry, boost::asio::ip::tcp::socket socket,
                    HttpRequest request, const WebProtocol& protocol, std::string name);

}  // namespace runnel::internal
