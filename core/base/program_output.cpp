#include "core/base/program_output.h"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel {

namespace {

// A signal that this process handles meanwhile ends no waiting.
template <typename Call>
auto Repeat(Call&& call) {
  auto answer = call();
  while (answer == -1 && errno == EINTR) answer = call();
  return answer;
}

std::string ReadAll(int file) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t size = 0; (size = Repeat([&] { return read(file, part.data(), part.size()); })) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(size));
  }
  return text;
}

// 0, or what posix_spawn() and its kin return.
int Start(ProgramStart& start, int output, pid_t& process) {
  std::vector<char*> words;
  for (std::string& word : start.words) words.push_back(word.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!start.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, start.folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  if (start.keeps_complaints) {
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  const int problem = posix_spawnp(&process, words.front(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return problem;
}

}  // namespace

Result<ProgramOutput> OutputOf(ProgramStart start) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return Error{.message = std::strerror(errno)};
  pid_t process = 0;
  const int problem = Start(start, ends[1], process);
  close(ends[1]);
  ProgramOutput output;
  if (problem == 0) output.text = ReadAll(ends[0]);
  close(ends[0]);
  if (problem != 0) return Error{.message = start.words.front() + " cannot be run: " + std::strerror(problem)};
  int status = 0;
  Repeat([&] { return waitpid(process, &status, 0); });
  output.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return output;
}

}  // namespace runnel
