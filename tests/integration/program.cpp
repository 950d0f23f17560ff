#include "tests/integration/program.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/wait_until.h"

namespace runnel::test {

namespace {

// As for an ordinary user, even where root runs the tests.
void GiveUpRealTimeRights() {
  prctl(PR_CAPBSET_DROP, CAP_SYS_NICE);
  const rlimit none{};
  setrlimit(RLIMIT_RTPRIO, &none);
}

[[noreturn]] void BecomeTheProgram(const std::string& command, int output) {
  // Who starts the tests in the background has them ignore what is to be tested.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  GiveUpRealTimeRights();
  setenv("RUNNEL_PLUGIN_PATH", RUNNEL_TEST_PLUGINS, 1);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
  _exit(127);
}

}  // namespace

Program::Program(const std::string& arguments, const std::string& program) {
  const std::string command = "exec " + program + " " + arguments;
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ == 0) {
    close(ends[0]);
    BecomeTheProgram(command, ends[1]);
  }
  close(ends[1]);
  output_ = ends[0];
}

Program::~Program() {
  close(output_);
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

bool Program::ReadMore() {
  std::array<char, 4096> part{};
  const ssize_t size = read(output_, part.data(), part.size());
  if (size > 0) text_.append(part.data(), static_cast<std::size_t>(size));
  return size > 0;
}

bool Program::WaitFor(const std::string& text) {
  while (text_.find(text) == std::string::npos) {
    if (!ReadMore()) return false;
  }
  return true;
}

bool Program::Handles(int signal) const {
  std::ifstream status("/proc/" + std::to_string(process_) + "/status");
  const std::string caught = "SigCgt:";
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(caught)) continue;
    return (std::stoull(line.substr(caught.size()), nullptr, 16) >> (signal - 1) & 1u) != 0;
  }
  return false;
}

void Program::WaitUntilHandles(int signal, bool handles) const {
  WaitUntil("the program handles signal " + std::to_string(signal) + (handles ? "" : " no more"),
            [&] { return Handles(signal) == handles; });
}

std::string Program::Maps() const {
  std::ifstream maps("/proc/" + std::to_string(process_) + "/maps");
  return {std::istreambuf_iterator<char>(maps), {}};
}

void Program::Send(int signal) const { kill(process_, signal); }

Ended Program::Wait() {
  while (ReadMore()) {
  }
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  Ended ended{.text = text_};
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
  return ended;
}

Ended Runnel(const std::string& arguments) { return Program(arguments).Wait(); }

}  // namespace runnel::test
