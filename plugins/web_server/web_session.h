#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace runnel {

/// One file of a page, as it lies in memory. All three outlive the server.
struct WebResource {
  std::string_view path;          ///< "/", "/page.js"; only exactly this is found
  std::string_view content_type;  ///< "text/javascript; charset=utf-8"
  std::string_view content;
};

/// What a client may do; each role may do what those before it may.
enum class WebRole {
  kLook,    ///< sees everything, changes nothing
  kDrive,   ///< moves the robot by hand: publishes, pauses
  kChange,  ///< whatever the owner of the application may
};

/// By number: "look", "drive", "change".
constexpr std::array<std::string_view, 3> kWebRoleNames{"look", "drive", "change"};

[[nodiscard]] constexpr std::string_view WebRoleName(WebRole role) {
  return kWebRoleNames[static_cast<std::size_t>(role)];
}
/// Nothing: there is no such role.
[[nodiscard]] constexpr std::optional<WebRole> WebRoleNamed(std::string_view name) {
  for (std::size_t i = 0; i < kWebRoleNames.size(); ++i) {
    if (kWebRoleNames[i] == name) return static_cast<WebRole>(i);
  }
  return {};
}

/// What a session says of a message when it has been read.
struct WebArrival {
  /// It is handed over at once, before what its client has said earlier and must not say so fast, and does not count.
  /// Of very few.
  bool outranks = false;
  bool may_be_late = false;  ///< others are refused rather than that they wait for long
  std::uint64_t mark = 0;    ///< the session's own, to find out when it is handed over what has happened meanwhile
  std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now();
};

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
  /// client or the server has gone. Does not throw; where there is no memory for it, the session has the turn that it
  /// has asked for itself.
  [[nodiscard]] virtual std::function<void()> Waker() = 0;
  /// The subprotocol that was agreed on.
  [[nodiscard]] virtual const std::string& protocol() const = 0;
  /// What it may do; the session sees to that.
  [[nodiscard]] virtual WebRole role() const = 0;
  /// Of the message that is being handed over; nothing: none is.
  [[nodiscard]] virtual std::optional<WebArrival> arrival() const { return {}; }

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
  /// As soon as the message has been read, which may be before those that were read earlier are handed over.
  [[nodiscard]] virtual WebArrival OnArrival(std::string_view /*message*/, bool /*is_text*/) { return {}; }
  /// In the place of handing it over: its client says too much.
  virtual void OnTooMany(std::string_view /*message*/, bool /*is_text*/) {}
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
