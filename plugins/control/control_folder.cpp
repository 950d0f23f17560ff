#include "plugins/control/control_folder.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/base/files.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".sock";
// Of a socket that is bound and to which nobody listens yet: not to be taken for one that was left.
constexpr const char* kStartingEnding = ".starting";
constexpr int kMostSocketsOfAProcess = 100;
constexpr int kWaitingConnections = 64;
constexpr time_t kPatience = 2;  // s

Error Untrusted(const fs::path& folder, const std::string& why) {
  return {.message = why,
          .position = {folder.string()},
          .hint =
              "running applications are reached through sockets in it, so it must be a folder "
              "that is yours alone (mode 0700); remove it, or set XDG_RUNTIME_DIR"};
}

Result<sockaddr_un> AddressOf(const fs::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof address.sun_path) {
    return Error{
        .message = "the path of a socket may have " + std::to_string(sizeof address.sun_path - 1) + " bytes at most",
        .position = {text},
        .hint = "set XDG_RUNTIME_DIR to a shorter one"};
  }
  std::memcpy(address.sun_path, text.c_str(), text.size());
  return address;
}

int OpenSocket(int more = SOCK_NONBLOCK) { return socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | more, 0); }

// How long connecting and sending wait; 0: for ever.
void SetPatience(int descriptor, time_t seconds) {
  const timeval wait{.tv_sec = seconds, .tv_usec = 0};
  setsockopt(descriptor, SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait);
}

int Connect(int descriptor, const sockaddr_un& address) {
  return connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

// Whether nobody will ever listen there any more.
bool IsStale(const fs::path& path) {
  const auto address = AddressOf(path);
  const FileDescriptor socket(address ? OpenSocket() : -1);
  return socket.is_open() && Connect(socket.number(), *address) != 0 && errno == ECONNREFUSED;
}

std::pair<long, std::string> OrderOf(const fs::path& path) {
  const std::string name = path.filename().string();
  long process = 0;
  std::from_chars(name.data(), name.data() + name.size(), process);
  return {process, name};
}

bool IsAlive(long process) { return kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH; }

Result<void> CheckStatus(const fs::path& folder, const struct stat& status) {
  if (!S_ISDIR(status.st_mode)) return Untrusted(folder, "is not a folder");
  if (status.st_uid != geteuid()) return Untrusted(folder, "belongs to another user");
  if ((status.st_mode & 0077) != 0) return Untrusted(folder, "is open to others");
  return {};
}

// A name that no other socket has, not even of another thread of this process.
fs::path StartingPath(const fs::path& folder) {
  static std::atomic<std::uint64_t> number{0};
  return folder / (std::to_string(getpid()) + "-" + std::to_string(++number) + kStartingEnding);
}

// The socket is its owner's from the first moment on.
Result<void> BindForOwner(int descriptor, const fs::path& path) {
  const auto address = AddressOf(path);
  if (!address) return address.error();
  if (fchmod(descriptor, 0600) != 0) return SystemError("its mode cannot be set", path);
  unlink(path.c_str());  // a process that had the same number may have left one
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0) {
    return SystemError("no socket can be made there", path);
  }
  if (chmod(path.c_str(), 0600) != 0 || listen(descriptor, kWaitingConnections) != 0) {
    Error error = SystemError("nobody can listen there", path);
    unlink(path.c_str());
    return error;
  }
  return {};
}

}  // namespace

fs::path ControlFolder() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime == '/') return fs::path(runtime) / "runnel";
  return "/tmp/runnel-" + std::to_string(geteuid());
}

Result<void> CheckControlFolder(const fs::path& folder) {
  struct stat status {};
  if (lstat(folder.c_str(), &status) == 0) return CheckStatus(folder, status);
  if (errno == ENOENT) return {};
  return SystemError("cannot be looked at", folder);
}

Result<void> MakeControlFolder(const fs::path& folder) {
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return SystemError("the folder for sockets cannot be made", folder);
  }
  return CheckControlFolder(folder);
}

Result<std::vector<fs::path>> FindControlSockets(const fs::path& folder) {
  if (auto checked = CheckControlFolder(folder); !checked) return checked.error();
  std::vector<fs::path> sockets;
  std::error_code none;
  for (const std::string& name : NamesInFolder(folder)) {
    const fs::path path = folder / name;
    if (path.extension() == kStartingEnding && !IsAlive(OrderOf(path).first)) unlink(path.c_str());
    if (path.extension() != kEnding || !fs::is_socket(path, none)) continue;
    if (!IsStale(path)) {
      sockets.push_back(path);
    } else if (!IsAlive(OrderOf(path).first)) {  // who lives may listen there anew by now
      unlink(path.c_str());
    }
  }
  std::ranges::sort(sockets, {}, OrderOf);
  return sockets;
}

Result<FileDescriptor> ConnectToSocket(const fs::path& path) {
  const auto address = AddressOf(path);
  if (!address) return address.error();
  FileDescriptor socket(OpenSocket(0));
  if (!socket.is_open()) return SystemError("no socket can be made", path);
  SetPatience(socket.number(), kPatience);  // many may be waiting there already
  if (Connect(socket.number(), *address) != 0) {
    if (errno != EAGAIN) return SystemError("cannot be reached", path);
    return Error{.message = "it does not answer: too many wait there already", .position = {path.string()}};
  }
  SetPatience(socket.number(), 0);
  return socket;
}

Result<ListeningSocket> ListenInFolder(const fs::path& folder) {
  if (auto made = MakeControlFolder(folder); !made) return made.error();
  const std::string process = std::to_string(getpid());
  for (int number = 0; number < kMostSocketsOfAProcess; ++number) {
    const std::string more = number == 0 ? "" : "-" + std::to_string(number);
    const fs::path path = folder / (process + more + kEnding);
    struct stat status {};
    // A process that had the same number may have left one.
    if (lstat(path.c_str(), &status) == 0 && (!IsStale(path) || unlink(path.c_str()) != 0)) continue;
    FileDescriptor socket(OpenSocket());
    if (!socket.is_open()) return SystemError("no socket can be made", path);
    const fs::path starting = StartingPath(folder);
    if (auto bound = BindForOwner(socket.number(), starting); !bound) return bound.error();
    // Under its own name it listens from the first moment on: who looks there never takes it for dead.
    // Another thread of this process may have taken the name meanwhile, and keeps it.
    const bool is_named = link(starting.c_str(), path.c_str()) == 0;
    const bool is_taken = errno == EEXIST;
    const Error error = SystemError("the socket cannot be named", path);
    unlink(starting.c_str());
    if (is_named) return ListeningSocket{std::move(socket), path};
    if (!is_taken) return error;
  }
  return Error{.message = "this process has too many sockets there already", .position = {folder.string()}};
}

}  // namespace runnel
