#include "apps/runnel/other_programs.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <unistd.h>

#include "core/base/files.h"
#include "plugins/real_time_check/sanitizer.h"

namespace runnel::program {

namespace {

constexpr std::string_view kPrefix = "runnel-";

std::filesystem::path OwnFolder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

bool IsProgram(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
}

constexpr const char* kVariable = "LD_PRELOAD";
// Says what has been preloaded to the process itself, and not to what that starts.
constexpr const char* kDone = "RUNNEL_PRELOADED";

std::string ValueOf(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr ? value : "";
}

std::vector<char*> OwnWords(std::string& text) {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  text.assign(std::istreambuf_iterator<char>(file), {});
  std::vector<char*> words;
  for (std::size_t at = 0; at < text.size(); at += std::strlen(&text[at]) + 1) {
    words.push_back(&text[at]);
  }
  words.push_back(nullptr);
  return words;
}

}  // namespace

std::vector<std::string> OtherCommands() {
  std::vector<std::string> commands;
  for (const std::string& name : NamesInFolder(OwnFolder())) {
    if (name.starts_with(kPrefix) && IsProgram(OwnFolder() / name)) {
      commands.push_back(name.substr(kPrefix.size()));
    }
  }
  return commands;
}

std::string BecomeProgram(const std::string& command, char** words) {
  const auto file = OwnFolder() / (std::string(kPrefix) + command);
  execv(file.c_str(), words);
  return file.string() + ": " + std::strerror(errno);
}

Result<void> PreloadAll(const std::vector<std::string>& libraries) {
  if (libraries.empty()) return {};
  // A sanitizer must be the first in the process, and does without.
  if (RUNNEL_UNDER_SANITIZER) return {};
  std::string list;
  for (const std::string& library : libraries) {
    std::error_code ignored;
    if (!std::filesystem::exists(library, ignored)) {
      return Error{.message = "this is not installed", .position = {library}};
    }
    list += library + ":";
  }
  const std::string before = ValueOf(kVariable);
  if (ValueOf(kDone) == list) {
    if (before == list) {
      unsetenv(kVariable);
    } else {
      setenv(kVariable, before.substr(list.size()).c_str(), 1);
    }
    unsetenv(kDone);
    return {};
  }
  setenv(kVariable, (list + before).c_str(), 1);
  setenv(kDone, list.c_str(), 1);
  std::string text;
  const std::vector<char*> words = OwnWords(text);
  execv("/proc/self/exe", words.data());
  return SystemError("the program cannot be started anew");
}

}  // namespace runnel::program
