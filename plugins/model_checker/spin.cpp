#include "plugins/model_checker/spin.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/temporary_folder.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr const char* kModel = "model.pml";
constexpr const char* kOutput = "output.txt";
constexpr int kTimeUp = 124;  // what `timeout` returns
constexpr int kNoSuchProgram = 127;

struct Ended {
  int code = 0;
  std::string output;
};

// By `timeout`, of Debian's coreutils, which ends all that Spin has started.
Ended Run(const TemporaryFolder& folder, int limit, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"timeout", std::to_string(limit), "spin"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, kOutput, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int problem = posix_spawnp(&process, "timeout", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) return {kNoSuchProgram, {}};
  int status = 0;
  waitpid(process, &status, 0);
  std::ostringstream text;
  text << std::ifstream(folder.path() / kOutput).rdbuf();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1, text.str()};
}

// What the model prints begins with "runnel ", which goes.
SpinAnswer ReadRun(const std::string& text) {
  constexpr std::string_view kMark = "runnel ";
  SpinAnswer answer;
  bool repeats = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("START OF CYCLE") != std::string::npos) {
      repeats = true;
      answer.repeats_from = answer.run.size();
    }
    const auto at = line.find(kMark);
    if (at != std::string::npos) answer.run.push_back(line.substr(at + kMark.size()));
  }
  if (!repeats) answer.repeats_from = answer.run.size();
  return answer;
}

bool Says(const Ended& ended, std::string_view text) { return ended.output.find(text) != std::string::npos; }

}  // namespace

Result<SpinAnswer> RunSpin(const std::string& model, const SpinSearch& search) {
  const auto folder = TemporaryFolder::Make("spin");
  if (!folder) return folder.error();
  std::ofstream(folder->path() / kModel) << model;
  std::vector<std::string> arguments = search.definitions;
  // Compiling well takes longer than what it saves.
  arguments.insert(arguments.end(), {"-run", "-O0", "-DMEMLIM=2000"});
  arguments.insert(arguments.end(), search.options.begin(), search.options.end());
  arguments.emplace_back(kModel);
  const Ended checked = Run(*folder, search.limit, arguments);
  if (checked.code == kNoSuchProgram) {
    return Error{.message = "is not checked, for the model checker spin is not here", .hint = "install the package spin"};
  }
  if (checked.code == kTimeUp) {
    return Error{.message = "is not decided: the model checker took more than " + std::to_string(search.limit) + " s"};
  }
  if (!Says(checked, "errors: ")) {
    return Error{.message = "is not checked, for the model checker says: " + checked.output.substr(0, 300),
                 .hint = "it needs a C compiler (gcc)"};
  }
  if (Says(checked, "errors: 0")) {
    if (Says(checked, "max search depth too small") || Says(checked, "Search not completed")) {
      return Error{.message = "is not decided: the model checker could not look at everything"};
    }
    return SpinAnswer{.holds = true};
  }
  std::vector<std::string> replay = search.definitions;
  replay.insert(replay.end(), {"-t", "-T", "-B", kModel});
  return ReadRun(Run(*folder, search.limit, replay).output);
}

}  // namespace runnel
