#include "tests/architecture/source_tree.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace runnel::test {

namespace {

namespace fs = std::filesystem;

void ReadFile(const fs::path& root, const fs::path& file, SourceTree& tree) {
  std::ifstream stream(file, std::ios::binary);
  tree[fs::relative(file, root).generic_string()] =
      std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

SourceTree ReadSourceTree(const fs::path& root) {
  SourceTree tree;
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    // ".git" is a file in a worktree.
    if (entry.is_regular_file() && entry.path().filename() != ".git") {
      ReadFile(root, entry.path(), tree);
    }
  }
  for (const char* top : {"apps", "bench", "core", "docs", "modules", "plugins", "tests", "xml"}) {
    if (!fs::exists(root / top)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.is_regular_file()) ReadFile(root, entry.path(), tree);
    }
  }
  return tree;
}

bool IsCode(std::string_view file) { return file.ends_with(".h") || file.ends_with(".cpp"); }

std::string FolderOf(std::string_view file) {
  const auto slash = file.rfind('/');
  return slash == std::string_view::npos ? "" : std::string(file.substr(0, slash));
}

std::string LibraryOf(std::string_view file) {
  const auto first = file.find('/');
  if (first == std::string_view::npos) return "";
  const auto second = file.find('/', first + 1);
  return second == std::string_view::npos ? "" : std::string(file.substr(0, second));
}

bool IsAtOrBelow(std::string_view file, std::string_view folder) {
  return file == folder ||
         (file.starts_with(folder) && file.substr(folder.size()).starts_with('/'));
}

std::vector<std::string_view> Lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace runnel::test
