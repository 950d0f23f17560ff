#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel::bench {

/// A component as a process, stepped, as long as this lives.
class StandaloneClient {
 public:
  explicit StandaloneClient(std::string program) {
    char folder[] = "/tmp/bench_genom_XXXXXX";
    if (mkdtemp(folder) == nullptr) throw std::runtime_error("no folder for a socket");
    folder_ = folder;
    path_ = folder_ + "/socket";
    std::string words[] = {std::move(program), "--stepped", "--socket", path_};
    char* const pointers[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
    if (posix_spawn(&process_, pointers[0], nullptr, nullptr, pointers, environ) != 0) {
      throw std::runtime_error(words[0] + " cannot be started");
    }
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.copy(address.sun_path, sizeof(address.sun_path) - 1);
    socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    while (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
      if (waitpid(process_, nullptr, WNOHANG) != 0) throw std::runtime_error(words[0] + " has ended");
      std::this_thread::yield();
    }
  }
  ~StandaloneClient() {
    close(socket_);
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    rmdir(folder_.c_str());
  }
  StandaloneClient(const StandaloneClient&) = delete;
  StandaloneClient& operator=(const StandaloneClient&) = delete;

  /// A line, and the line that answers it.
  std::string Ask(std::string line) {
    line += '\n';
    if (send(socket_, line.data(), line.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(line.size())) return "is gone";
    std::string heard;
    for (char each = 0; recv(socket_, &each, 1, 0) == 1 && each != '\n';) heard += each;
    return heard;
  }

 private:
  std::string folder_, path_;
  pid_t process_ = -1;
  int socket_ = -1;
};

}  // namespace runnel::bench
