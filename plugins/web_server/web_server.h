#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/web_server/web_server_options.h"
#include "plugins/web_server/web_session.h"

namespace runnel {

/// Gives browsers a few files by HTTP, and talks to them and others by WebSocket. Knows nothing of what it
/// is about. See README.md for what it refuses, and why.
///
/// Threads:    one of its own, which serves all clients; no client makes it wait. clients() from
///             any thread; the rest from one.
/// Allocation: as its limits say.
/// Errors:     of Start(): the address or port cannot be had, the token is none. Clients' mistakes are
///             answered, and go no further.
class WebServer {
 public:
  static Result<std::unique_ptr<WebServer>> Start(WebServerOptions options, const std::vector<WebResource>& resources,
                                                  std::vector<WebProtocol> protocols);
  /// Tells clients that it ends, and waits for them for a moment.
  virtual ~WebServer() = default;

  /// What to open in a browser: "http://127.0.0.1:8765/".
  [[nodiscard]] virtual const std::string& url() const noexcept = 0;
  /// The token that has been made because there was none; "" if none was needed.
  [[nodiscard]] virtual const std::string& made_token() const noexcept = 0;
  [[nodiscard]] virtual std::uint16_t port() const noexcept = 0;
  /// WebSockets that are open.
  [[nodiscard]] virtual std::size_t clients() const noexcept = 0;
};

}  // namespace runnel
