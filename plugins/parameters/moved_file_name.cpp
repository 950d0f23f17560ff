#include "plugins/parameters/moved_file_name.h"

namespace runnel {

namespace fs = std::filesystem;

fs::path Whole(const fs::path& path) {
  std::error_code ignored;
  // The folder of a bare name is "", of which nothing is absolute.
  return fs::weakly_canonical(fs::absolute(path.empty() ? fs::path(".") : path, ignored), ignored);
}

std::string MovedFileName(const std::string& name, const fs::path& from, const fs::path& to) {
  if (name.empty() || fs::path(name).is_absolute()) return name;
  const fs::path moved = Whole(from / name).lexically_relative(Whole(to));
  return moved.empty() ? name : moved.string();
}

}  // namespace runnel
