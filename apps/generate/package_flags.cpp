#include "apps/generate/package_flags.h"

#include <array>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace runnel {

namespace {

struct Answer {
  std::string text;
  int status = -1;  // as of wait
};

// What the program writes; its complaints are of no use to whoever wrote a description.
Answer Ask(std::array<const char*, 4> words) {
  Answer answer;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return answer;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, words[0], &actions, nullptr, const_cast<char**>(words.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; failed == 0 && (got = read(ends[0], buffer.data(), buffer.size())) > 0;) {
    answer.text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  close(ends[0]);
  if (failed == 0) waitpid(process, &answer.status, 0);
  return answer;
}

}  // namespace

Result<std::vector<std::string>> FlagsOfPackage(const std::string& package) {
  const Answer answer = Ask({"pkg-config", "--cflags", package.c_str(), nullptr});
  if (answer.status != 0) {
    return Error{.message = "pkg-config knows no package '" + package + "'",
                 .hint = "install it, or say by PKG_CONFIG_PATH where its .pc file is"};
  }
  std::istringstream words(answer.text);
  std::vector<std::string> flags;
  for (std::string word; words >> word;) flags.push_back(word);
  return flags;
}

}  // namespace runnel
