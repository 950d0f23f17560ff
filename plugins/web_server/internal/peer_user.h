#pragma once

#include <cstdint>
#include <optional>

#include <boost/asio/ip/tcp.hpp>

namespace runnel::internal {

/// Whose process is at the other end of a connection within this machine. Nothing: it is another machine, the
/// process has closed its end already, or the system does not say. Asks the system, and waits for no process.
[[nodiscard]] std::optional<std::uint32_t> UserOfPeer(const boost::asio::ip::tcp::socket& socket);

}  // namespace runnel::internal
