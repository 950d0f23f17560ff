#pragma once

#include <functional>
#include <map>
#include <string>

#include "core/base/result.h"

namespace runnel::genom_standalone {

/// Lines of text between this process and clients at a Unix socket.
///
/// Threads: one, but Wake(), which any may call, also signal handlers.
class LineServer {
 public:
  using Client = int;

  LineServer();
  /// Ends all sessions, and removes the socket.
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  /// Errors: the path cannot be had, or somebody listens there.
  [[nodiscard]] Result<void> Listen(const std::string& path);
  /// Until lines have come, or Wake() was called; each goes to `take`, without its end.
  void Serve(const std::function<void(Client, const std::string&)>& take, const std::function<void(Client)>& gone);
  /// To a client that is gone: to nobody.
  void Send(Client client, const std::string& line);
  /// What has been sent goes out, for a second at most.
  void Flush();
  void Wake() noexcept;

 private:
  struct Session {
    std::string received = {}, unsent = {};
  };
  void Accept();
  [[nodiscard]] bool Receive(Client client, Session& session);
  [[nodiscard]] bool SendMore(Client client, Session& session);

  std::string path_;
  int listening_ = -1;
  int woken_ = -1;
  std::map<Client, Session> sessions_;
};

}  // namespace runnel::genom_standalone
