#include "apps/runnel/other_programs.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

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

}  // namespace

std::vector<std::string> OtherCommands() {
  std::vector<std::string> commands;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(OwnFolder(), error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kPrefix) && IsProgram(entry.path())) {
      commands.push_back(name.substr(kPrefix.size()));
    }
  }
  std::ranges::sort(commands);
  return commands;
}

std::string BecomeProgram(const std::string& command, char** words) {
  const auto file = OwnFolder() / (std::string(kPrefix) + command);
  execv(file.c_str(), words);
  return file.string() + ": " + std::strerror(errno);
}

}  // namespace runnel::program
