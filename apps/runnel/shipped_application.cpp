#include "apps/runnel/shipped_application.h"

#include <filesystem>

namespace runnel::program {

namespace fs = std::filesystem;

std::string ApplicationFile(const std::string& word) {
  std::error_code error;
  const fs::path path(word);
  if (word.empty() || path.has_parent_path() || fs::exists(path, error)) return word;
  // Beside the program, in the build tree as where it is installed.
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  const fs::path shipped = folder / "share/runnel/xml/apps" / (path.stem().string() + ".xml");
  return fs::is_regular_file(shipped, error) ? shipped.string() : word;
}

}  // namespace runnel::program
