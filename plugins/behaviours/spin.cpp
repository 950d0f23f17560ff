#include "plugins/behaviours/spin.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr const char* kModel = "network.pml";
constexpr const char* kOutput = "output.txt";
constexpr const char* kLimit = "60";  // s
constexpr int kTimeUp = 124;          // what `timeout` returns
constexpr int kNoSuchProgram = 127;

/// Where Spin writes its checker; goes with its object.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "runnel_spin_XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Ended {
  int code = 0;
  std::string output;
};

// By `timeout`, of Debian's coreutils, which ends all that Spin has started.
Ended Run(const Folder& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"timeout", kLimit, "spin"};
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

Counterexample ReadRun(const std::string& text, std::size_t behaviours) {
  Counterexample run;
  bool repeats = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("START OF CYCLE") != std::string::npos) {
      repeats = true;
      run.repeats_from = run.cycles.size();
    }
    const auto at = line.find("runnel ");
    if (at == std::string::npos || line.size() < at + 7 + behaviours) continue;
    std::vector<bool> active;
    for (std::size_t i = 0; i < behaviours; ++i) active.push_back(line[at + 7 + i] == '1');
    run.cycles.push_back(std::move(active));
  }
  if (!repeats) run.repeats_from = run.cycles.size();
  return run;
}

}  // namespace

Result<SpinVerdict> RunSpin(const BehaviourNetwork& network, const NetworkProperty& property) {
  const Folder folder;
  if (folder.path().empty()) return Error{.message = "no folder can be made for the model checker"};
  std::ofstream(folder.path() / kModel) << PromelaText(network, &property);
  const bool is_never = property.kind == NetworkProperty::Kind::kNever;
  const Ended checked = Run(folder, {"-run", is_never ? "-bfs" : "-a", kModel});
  if (checked.code == kNoSuchProgram) {
    return Error{.message = "is not checked, for the model checker spin is not here", .hint = "install the package spin"};
  }
  if (checked.code == kTimeUp) return Error{.message = "is not decided: the model checker took more than a minute"};
  if (checked.output.find("errors: 0") != std::string::npos) return SpinVerdict{.holds = true};
  if (checked.output.find("errors: ") == std::string::npos) {
    return Error{.message = "is not checked, for the model checker says: " + checked.output.substr(0, 300),
                 .hint = "it needs a C compiler (gcc)"};
  }
  const Ended replayed = Run(folder, {"-t", kModel});
  return SpinVerdict{.holds = false, .counterexample = ReadRun(replayed.output, network.nodes.size())};
}

std::string TellCounterexample(const BehaviourNetwork& network, const Counterexample& counterexample) {
  std::string text;
  for (std::size_t cycle = 0; cycle < counterexample.cycles.size(); ++cycle) {
    const auto& active = counterexample.cycles[cycle];
    const bool begins_loop = cycle == counterexample.repeats_from;
    if (cycle > 0 && !begins_loop && active == counterexample.cycles[cycle - 1]) continue;
    std::string names;
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (active[i]) names += (names.empty() ? "" : ", ") + network.nodes[i].name;
    }
    text += (text.empty() ? "" : "; then ") + std::string(begins_loop ? "over and over: " : "") +
            (names.empty() ? "nobody" : names);
  }
  return text;
}

}  // namespace runnel
