#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "core/base/result.h"
#include "plugins/web_server/internal/connection_registry.h"

namespace runnel::internal {

using HttpRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// Serves one connection that has been accepted, until it ends or becomes a session. `user`: whose process of this
/// machine is at the other end, if the rules ask for that and the system says. `visitor`: whoever is in the registry for it
/// until it becomes a session; nullptr: it is itself.
void ServeHttp(ConnectionRegistry& registry, boost::asio::ip::tcp::socket socket, std::optional<std::uint32_t> user,
               std::shared_ptr<WebConnection> visitor = nullptr);

/// Goes on with a connection whose request for a WebSocket has been granted. `name`: of the protocol,
/// as it is answered. `role`: what the client may do.
void ServeWebSocket(ConnectionRegistry& registry, boost::asio::ip::tcp::socket socket, HttpRequest request,
                    const WebProtocol& protocol, std::string name, WebRole role);

/// Whose process is at the other end of a connection within this machine. Nothing: it is another machine, the
/// process has closed its end already, or the system does not say. Asks the system, and waits for no process.
[[nodiscard]] std::optional<std::uint32_t> UserOfPeer(const boost::asio::ip::tcp::socket& socket);

/// A certificate with its key, by which a server shows who it is.
class TlsIdentity;

/// Reads both (PEM). `key_file` "": it is in the file of the certificate. Errors: a file cannot be read, has none, is
/// read by everybody (the key's), or the two do not belong together; with the file, and how it is mended.
[[nodiscard]] Result<std::shared_ptr<TlsIdentity>> LoadTlsIdentity(const std::filesystem::path& certificate_file,
                                                                   const std::filesystem::path& key_file);

/// Agrees on keys with a client that has been accepted; then serves what it says, in the clear within this process, by
/// ServeHttp(). `user`: see ServeHttp().
void ServeTls(ConnectionRegistry& registry, const std::shared_ptr<TlsIdentity>& identity,
              boost::asio::ip::tcp::socket socket, std::optional<std::uint32_t> user);

}  // namespace runnel::internal
