#include "core/base/folder_names.h"

#include <algorithm>
#include <memory>

#include <dirent.h>

namespace runnel {

// Not by std::filesystem::directory_iterator, which ends the process in GCC 12 when there is no memory for
// a path, and which throws at an entry that cannot be read.
std::vector<std::string> NamesInFolder(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  const std::unique_ptr<DIR, int (*)(DIR*)> listing(opendir(folder.empty() ? "." : folder.c_str()), closedir);
  if (!listing) return names;
  while (const dirent* const entry = readdir(listing.get())) {
    std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(std::move(name));
  }
  std::ranges::sort(names);  // the order of a directory is nobody's
  return names;
}

}  // namespace runnel
