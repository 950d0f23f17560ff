#include "tests/plugins/genom_standalone/standalone_process.h"

#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel::test {

StandaloneProcess::StandaloneProcess(const std::string& program, std::initializer_list<const char*> options) {
  const std::string path = (folder_ / "socket").string();
  std::vector<std::string> words{program, "--socket", path};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  if (posix_spawn(&process_, program.c_str(), nullptr, nullptr, pointers.data(), environ) != 0) {
    throw std::runtime_error(program + " cannot be started");
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  while (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) {
      process_ = -1;
      throw std::runtime_error(program + " has ended");
    }
    std::this_thread::yield();
  }
}

StandaloneProcess::~StandaloneProcess() {
  close(socket_);
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
}

void StandaloneProcess::Say(const std::string& line) { SendAll(line + "\n"); }

void StandaloneProcess::SayLast(const std::string& text) {
  SendAll(text);
  shutdown(socket_, SHUT_WR);
}

void StandaloneProcess::SendAll(const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t more = send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (more <= 0) return;
    sent += static_cast<std::size_t>(more);
  }
}

Json StandaloneProcess::Hear() {
  std::size_t end = 0;
  while ((end = received_.find('\n')) == std::string::npos) {
    std::array<char, 65536> buffer{};
    const ssize_t got = read(socket_, buffer.data(), buffer.size());
    if (got <= 0) return "gone";
    received_.append(buffer.data(), static_cast<std::size_t>(got));
  }
  const std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  return Json::parse(line);
}

void StandaloneProcess::Send(int signal) const { kill(process_, signal); }

void StandaloneProcess::LimitMemory(std::size_t more) const {
  std::size_t pages = 0;
  std::ifstream("/proc/" + std::to_string(process_) + "/statm") >> pages;
  const std::size_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{most, most};
  prlimit(process_, RLIMIT_AS, &limit, nullptr);
}

int StandaloneProcess::Wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool StandaloneProcess::has_socket() const { return std::filesystem::exists(folder_ / "socket"); }

}  // namespace runnel::test
