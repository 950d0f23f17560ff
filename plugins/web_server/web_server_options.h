#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "plugins/web_server/access_tokens.h"

namespace runnel {

/// What clients can cost at most.
struct WebLimits {
  std::size_t header_bytes = 8 * 1024;
  std::size_t message_bytes = 1 << 20;  ///< of one message from a client
  std::size_t clients = 64;             ///< WebSockets at once, and as many more for those of WebProtocol::kept_name
  std::size_t visitors = 64;            ///< plain connections at once; the oldest makes room
  double messages_per_second = 200;     ///< of one client, each 4 kB counting as one; more waits or is refused
  std::size_t waiting_bytes = 8 << 20;  ///< for one client that does not read
  /// For a whole request to come, a handshake, and some of an answer to be taken.
  Duration request_time = std::chrono::seconds(10);
  /// Without a sign of life, for which pings ask; with TLS, and of WebSockets, for some of what is sent to be taken.
  Duration idle_time = std::chrono::seconds(30);
};

struct WebServerOptions {
  /// Of the machine, "127.0.0.1" or "::1"; "0.0.0.0" or "::" for all networks.
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;  ///< 0: any that is free
  /// Files (PEM) by which it encrypts: https, wss. Without, other addresses than loopback are refused; the key may be
  /// in the file of the certificate.
  std::string certificate_file = {};
  std::string key_file = {};
  /// Other addresses are served in the clear all the same: for networks that nobody else is on, and behind a proxy
  /// that encrypts.
  bool is_insecure = false;
  /// What clients must show who want to talk, and what they may do then: among the protocols that they offer, as
  /// "runnel.token.…" (the page does, with what stands behind '#' in its address), as ?token=… in the address of the
  /// WebSocket, or as "Authorization: Bearer …". None: on a loopback address nobody needs one; on others one is
  /// made, which may do everything.
  std::vector<AccessToken> tokens = {};
  /// On a loopback address without a token: all users of this machine may do everything, not only who has
  /// started this.
  bool is_for_all_users = false;
  /// Pages of other places that may talk to this server: "https://app.example.org".
  std::vector<std::string> origins = {};
  /// Names, besides addresses, localhost and, but on a loopback address, the machine's own, by which clients may
  /// call it.
  std::vector<std::string> host_names = {};
  WebLimits limits = {};
};

}  // namespace runnel
