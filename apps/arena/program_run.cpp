#include "apps/arena/program_run.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel::arena {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLook{50};  // how often it is looked whether to stop

Error SystemError(const std::string& what) {
  return {.message = what + ": " + std::strerror(errno)};
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Calls nothing that a child of a program with several threads may not call.
[[noreturn]] void BecomeTheProgram(const std::vector<char*>& words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);     // when the thread ends that has made it, which waits for it
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

// `descriptor` becomes readable when the process has ended. Whether it has until `end`, or was to stop.
bool WaitForEnd(int descriptor, Clock::time_point end, const std::atomic<bool>& is_to_stop) {
  pollfd polled{.fd = descriptor, .events = POLLIN, .revents = 0};
  while (!is_to_stop) {
    const auto left = std::chrono::ceil<milliseconds>(end - Clock::now());
    if (left <= milliseconds(0)) return false;
    if (poll(&polled, 1, static_cast<int>(std::min(left, kLook).count())) > 0) break;
  }
  return true;
}

}  // namespace

Result<ProgramEnding> RunProgram(const std::vector<std::string>& words,
                                 const std::filesystem::path& output,
                                 std::chrono::duration<double> limit,
                                 const std::atomic<bool>& is_to_stop) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) return SystemError(output.string());
  const auto began = Clock::now();
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) BecomeTheProgram(pointers, file, parent);
  close(file);
  if (process < 0) return SystemError("no process can be started");
  // By its number: the header of glibc 2.36 is not for C++.
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  const Error unwatched = SystemError("a process cannot be watched");
  ProgramEnding ending;
  if (descriptor >= 0) {
    const auto end = began + std::chrono::duration_cast<Clock::duration>(limit);
    ending.has_hung = !WaitForEnd(descriptor, end, is_to_stop);
    close(descriptor);
  }
  kill(process, SIGKILL);  // if it still runs; its number is its own until it has been waited for
  int status = 0;
  rusage usage{};
  while (wait4(process, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  if (descriptor < 0) return unwatched;
  ending.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  ending.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  ending.wall_time = std::chrono::duration<double>(Clock::now() - began).count();
  ending.processor_time = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  return ending;
}

}  // namespace runnel::arena
