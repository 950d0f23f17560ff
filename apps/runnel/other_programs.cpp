#include "apps/runnel/other_programs.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "core/base/folder_names.h"

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

}  // namespace runnel::program
