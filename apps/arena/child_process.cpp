#include "apps/arena/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel::arena {

namespace {

Error SystemError(const std::string& what) {
  return {.message = what + ": " + std::strerror(errno)};
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

[[noreturn]] void BecomeTheProgram(const std::vector<char*>& words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // it has died meanwhile
  setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(words.front(), words.data());
  _exit(127);
}

}  // namespace

Result<ChildProcess> ChildProcess::Start(const std::vector<std::string>& words,
                                         const std::filesystem::path& output) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) return SystemError(output.string());
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) BecomeTheProgram(pointers, file, parent);
  close(file);
  if (process < 0) return SystemError("no process can be started");
  // By its number: the header of glibc 2.36 is not for C++.
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (descriptor < 0) {
    Error error = SystemError("a process cannot be watched");
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    return error;
  }
  return ChildProcess(process, descriptor);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      started_at_(other.started_at_),
      ending_(other.ending_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(started_at_, other.started_at_);
  std::swap(ending_, other.ending_);
  return *this;
}

ChildProcess::~ChildProcess() {
  if (process_ > 0 && !ending_) {
    Kill();
    waitpid(process_, nullptr, 0);
  }
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<ChildProcess::Ending> ChildProcess::Look() {
  int status = 0;
  rusage usage{};
  if (!ending_ && wait4(process_, &status, WNOHANG, &usage) == process_) {
    ending_ = Ending{.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                     .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                     .processor_time = Seconds(usage.ru_utime) + Seconds(usage.ru_stime)};
  }
  return ending_;
}

void ChildProcess::Kill() {
  if (!ending_) kill(process_, SIGKILL);
}

}  // namespace runnel::arena
