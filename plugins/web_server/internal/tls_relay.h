#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include <boost/asio/ip/tcp.hpp>

#include "core/base/result.h"
#include "plugins/web_server/internal/connection_registry.h"

namespace runnel::internal {

/// A certificate with its key, by which a server shows who it is.
class TlsIdentity;

/// Reads both (PEM). `key_file` "": it is in the file of the certificate. Errors: a file cannot be read, has none, is
/// read by everybody (the key's), or the two do not belong together; with the file, and how it is mended.
[[nodiscard]] Result<std::shared_ptr<TlsIdentity>> LoadTlsIdentity(
    const std::filesystem::path& certificate_file, const std::filesystem::path& key_file);

/// Agrees on keys with a client that has been accepted; then serves what it says, in the clear within this process, by
/// ServeHttp(). `user`: see ServeHttp().
void ServeTls(ConnectionRegistry& registry, const std::shared_ptr<TlsIdentity>& identity,
              boost::asio::ip::tcp::socket socket, std::optional<std::uint32_t> user);

}  // namespace runnel::internal
