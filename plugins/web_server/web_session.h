#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/web_server/web_role.h"

namespace runnel {

/// One peer at the other end of a WebSocket, as a session sees it.
///
/// Threads:  the server's only, but for what Waker() returns.
class WebClient {
 public:
  /// Sends one message. False: too much is waiting for a client that is slow, and this is not sent;
  /// what comes when nothing is waiting is always taken.
  virtual bool SendText(std::string text) = 0;
  virtual bool SendBinary(std::string bytes) = 0;
  /// Not yet taken by the client: send less often if it grows.
  [[nodiscard]] virtual std::size_t waiting_bytes() const = 0;
  /// Says why, and ends the session; nothing is sent or received any more.
  virtual void Close(std::string reason) = 0;
  /// Gives the session a turn. May be kept and called by any thread, and does nothing once the
  /// client or the server has gone.
  [[nodiscard]] virtual std::function<void()> Waker() = 0;
  /// The subprotocol that was agreed on.
  [[nodiscard]] virtual const std::string& protocol() const = 0;
  /// What it may do; the session sees to that.
  [[nodiscard]] virtual WebRole role() const = 0;

 protected:
  ~WebClient() = default;
};

/// What is said to one client: made when it comes, destroyed when it has gone. Text is valid UTF-8.
///
/// Threads:  the server's, which serves all clients: nothing here may wait, neither for a lock nor for a
///           file. Destroyed by it, or by who destroys the server.
/// Errors:   whatever is thrown ends this session and is told to the client; others go on.
class WebSession {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  virtual ~WebSession() = default;
  virtual void OnText(std::string_view message) = 0;
  virtual void OnBinary(std::string_view message) = 0;
  /// Whether the message is handed over as soon as it has been read, before what its client has said earlier and must not say
  /// so fast, and does not count. Of very few.
  [[nodiscard]] virtual bool OutranksLimits(std::string_view /*message*/, bool /*is_text*/) const { return false; }
  /// At the start, whenever due, after each message, and when its client's Waker() is called. Returns when
  /// it wants the next turn.
  virtual SteadyTime OnPoll() = 0;
};

/// A kind of session, which clients choose by one of its names (Sec-WebSocket-Protocol).
struct WebProtocol {
  std::vector<std::string> names;
  /// The client outlives the session.
  std::function<std::unique_ptr<WebSession>(WebClient& client)> start;
  /// One of the names, "" if none: as many more sessions by this name may be there at once; they make room for their like only.
  std::string kept_name = {};
};

}  // namespace runnel
