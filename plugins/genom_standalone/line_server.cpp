#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <vector>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "plugins/genom_standalone/request_server.h"

namespace runnel::genom_standalone {

namespace {

constexpr std::size_t kLongestLine = 4U << 20;  // JSON takes 20 times as much memory, and nobody else is heard
constexpr std::size_t kMostUnsent = 64U << 20;  // of a client that does not read
constexpr int kFlushMilliseconds = 1000;

bool SomebodyListens(const sockaddr_un& address) {
  const FileDescriptor probe(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  return connect(probe.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

}  // namespace

LineServer::LineServer() : woken_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

LineServer::~LineServer() {
  if (listening_.is_open()) unlink(path_.c_str());
}

Result<void> LineServer::Listen(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) return Error{.message = "is too long for a socket", .path = path};
  std::memcpy(address.sun_path, path.data(), path.size());
  FileDescriptor listening(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (bind(listening.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    std::error_code ignored;
    const bool is_left = errno == EADDRINUSE && std::filesystem::is_socket(path, ignored) && !SomebodyListens(address);
    // Of one that was killed.
    if (is_left) unlink(path.c_str());
    if (!is_left || bind(listening.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
      if (!is_left && errno == ECONNREFUSED) errno = EADDRINUSE;
      return SystemError("cannot be listened at", path);
    }
  }
  if (chmod(path.c_str(), 0600) != 0 || listen(listening.number(), 16) != 0) {
    return SystemError("cannot be listened at", path);
  }
  path_ = path;
  listening_ = std::move(listening);
  return {};
}

void LineServer::Wake() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(woken_.number(), &one, sizeof(one));
}

void LineServer::Accept() {
  FileDescriptor socket(accept4(listening_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (socket.is_open()) sessions_[socket.number()].socket = std::move(socket);
}

// False: it is gone.
bool LineServer::Receive(Client client, Session& session) {
  std::array<char, 65536> buffer{};
  const ssize_t got = read(client, buffer.data(), buffer.size());
  if (got < 0) return errno == EAGAIN || errno == EINTR;
  session.received.append(buffer.data(), static_cast<std::size_t>(got));
  session.has_said_all = got == 0;
  if (session.has_said_all && !session.received.empty()) session.received += '\n';
  return session.received.size() <= kLongestLine;
}

bool LineServer::SendMore(Client client, Session& session) {
  while (!session.unsent.empty()) {
    const ssize_t sent = send(client, session.unsent.data(), session.unsent.size(), MSG_NOSIGNAL);
    if (sent < 0) return errno == EAGAIN || errno == EINTR;
    session.unsent.erase(0, static_cast<std::size_t>(sent));
  }
  return true;
}

void LineServer::Serve(const std::function<void(Client, const std::string&)>& take,
                       const std::function<void(Client)>& gone, const std::function<bool(Client)>& waits) {
  std::erase_if(sessions_, [&](const auto& each) {
    return each.second.has_said_all && each.second.unsent.empty() && !waits(each.first);
  });
  std::vector<pollfd> waiting{{listening_.number(), POLLIN, 0}, {woken_.number(), POLLIN, 0}};
  for (const auto& [client, session] : sessions_) {
    const int events = (session.has_said_all ? 0 : POLLIN) | (session.unsent.empty() ? 0 : POLLOUT);
    waiting.push_back({client, static_cast<short>(events), 0});
  }
  if (poll(waiting.data(), waiting.size(), -1) < 0) return;
  if ((waiting[1].revents & POLLIN) != 0) {
    std::uint64_t times = 0;
    [[maybe_unused]] const ssize_t got = read(woken_.number(), &times, sizeof(times));
  }
  for (std::size_t i = 2; i < waiting.size(); ++i) {
    const Client client = waiting[i].fd;
    if (waiting[i].revents == 0) continue;
    Session& session = sessions_[client];
    bool stays = (waiting[i].revents & POLLOUT) == 0 || SendMore(client, session);
    if ((waiting[i].revents & (POLLIN | POLLHUP | POLLERR)) != 0) stays = Receive(client, session) && stays;
    for (std::size_t end = 0; (end = session.received.find('\n')) != std::string::npos;) {
      const std::string line = session.received.substr(0, end);
      session.received.erase(0, end + 1);
      take(client, line);
    }
    // It may have closed only its own side; then it listens.
    if (session.has_said_all && (waiting[i].revents & (POLLHUP | POLLERR)) != 0) stays = false;
    if (stays && session.unsent.size() <= kMostUnsent) continue;
    gone(client);
    sessions_.erase(client);
  }
  if ((waiting[0].revents & POLLIN) != 0) Accept();
}

void LineServer::Send(Client client, const std::string& line) {
  const auto found = sessions_.find(client);
  if (found == sessions_.end()) return;
  found->second.unsent += line + "\n";
  (void)SendMore(client, found->second);  // who is gone is noticed when it is read from
}

void LineServer::Flush() {
  for (auto& [client, session] : sessions_) {
    pollfd waiting{client, POLLOUT, 0};
    while (!session.unsent.empty() && poll(&waiting, 1, kFlushMilliseconds) > 0 && SendMore(client, session)) {
      if ((waiting.revents & (POLLERR | POLLHUP)) != 0) break;
    }
  }
}

}  // namespace runnel::genom_standalone
