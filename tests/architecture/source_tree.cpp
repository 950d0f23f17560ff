#include "tests/architecture/source_tree.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

namespace runnel::test {

namespace {

namespace fs = std::filesystem;

const std::set<std::string> kTops{"apps", "bench", "core", "docs", "modules", "plugins", "tests", "xml"};

bool IsOfTree(const fs::path& name) {
  // ".git" is a file in a worktree.
  return name.has_parent_path() ? kTops.contains(name.begin()->string()) : name != ".git";
}

void ReadFile(const fs::path& root, const fs::path& name, SourceTree& tree) {
  if (!IsOfTree(name) || !fs::is_regular_file(root / name)) return;
  std::ifstream stream(root / name, std::ios::binary);
  tree[name.generic_string()] = std::string(std::istreambuf_iterator<char>(stream), {});
}

// Empty where git is not there, or does not know the folder.
std::vector<std::string> TrackedFiles(const fs::path& root) {
  const std::string command = "git -C '" + root.string() + "' ls-files -z 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::vector<std::string> names;
  std::string name;
  for (int character = 0; pipe != nullptr && (character = std::fgetc(pipe.get())) != EOF;) {
    if (character != 0) {
      name += static_cast<char>(character);
    } else {
      names.push_back(std::exchange(name, ""));
    }
  }
  return names;
}

}  // namespace

SourceTree ReadSourceTree(const fs::path& root) {
  SourceTree tree;
  for (const std::string& name : TrackedFiles(root)) ReadFile(root, name, tree);
  if (!tree.empty()) return tree;
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    const fs::path name = entry.path().filename();
    ReadFile(root, name, tree);
    if (!entry.is_directory() || !kTops.contains(name.string())) continue;
    for (const fs::directory_entry& inner : fs::recursive_directory_iterator(entry)) {
      ReadFile(root, fs::relative(inner.path(), root), tree);
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
  return file == folder || (file.starts_with(folder) && file.substr(folder.size()).starts_with('/'));
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
