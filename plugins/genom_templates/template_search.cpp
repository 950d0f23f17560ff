#include "plugins/genom_templates/template_run.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/base/folder_names.h"
#include "core/base/nearest_name.h"

namespace runnel::genom {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> Folders() {
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("RUNNEL_GENOM_TEMPLATES")) {
    std::istringstream parts(own);
    for (std::string part; std::getline(parts, part, ':');) {
      if (!part.empty()) folders.emplace_back(part);
    }
  }
  folders.push_back(TemplatesOfRunnel());
  return folders;
}

bool IsTemplate(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "template.lua", error);
}

}  // namespace

fs::path TemplatesOfRunnel() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "share/runnel/genom_templates";
}

std::vector<std::string> TemplateNames() {
  std::vector<std::string> names;
  for (const fs::path& folder : Folders()) {
    for (const std::string& name : NamesInFolder(folder)) {
      if (IsTemplate(folder / name)) names.push_back(name);
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Result<fs::path> FindTemplate(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (IsTemplate(name)) return fs::path(name);
    return Error{.message = "there is no template in '" + name + "'", .hint = "a template is a folder with a file template.lua"};
  }
  for (const fs::path& folder : Folders()) {
    if (IsTemplate(folder / name)) return folder / name;
  }
  return Error{.message = "there is no template '" + name + "'", .hint = NearestNameHint(name, TemplateNames())};
}

}  // namespace runnel::genom
