#include <dlfcn.h>

#include "core/base/files.h"
#include "core/base/nearest_name.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

// From the folder of a library to the root of its installation: lib, lib/<architecture>, lib/runnel/plugins.
constexpr int kMostLevels = 4;

fs::path InstalledXmlFolder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&XmlFolder), &info) == 0) return {};
  std::error_code ignored;
  // The loader may have come by a link: /lib is one to /usr/lib.
  fs::path folder = fs::weakly_canonical(info.dli_fname, ignored).parent_path();
  for (int level = 0; level < kMostLevels; ++level) {
    folder = folder.parent_path();
    fs::path xml = folder / "share" / "runnel" / "xml";
    if (fs::is_directory(xml, ignored)) return xml;
  }
  return {};
}

Error NoSuchWorld(const std::string& word, std::vector<std::string> names) {
  const fs::path path(word);
  if (path.has_parent_path()) {  // a misspelt file: what is beside it?
    names.clear();
    for (const std::string& name : XmlNamesIn(path.parent_path())) {
      names.push_back((path.parent_path() / (name + ".xml")).string());
    }
  }
  if (names.empty()) {
    return {.message = "there is no world '" + word + "'",
            .hint = "nor any other in that folder; those that come with Runnel are named without one, like 'rooms'"};
  }
  return {.message = "there is no world '" + word + "'", .hint = NearestNameHint(word, names)};
}

}  // namespace

fs::path XmlFolder() {
  const fs::path installed = InstalledXmlFolder();
  return installed.empty() ? fs::path(RUNNEL_XML) : installed;
}

std::vector<std::string> XmlNamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path name : NamesInFolder(folder)) {
    if (name.extension() == ".xml") names.push_back(name.stem().string());
  }
  return names;
}

Result<fs::path> FindWorldFile(const std::string& word) {
  std::error_code ignored;
  const fs::path path(word);
  if (fs::is_regular_file(path, ignored)) return fs::absolute(path);
  const fs::path worlds = XmlFolder() / "worlds";
  if (!path.has_parent_path() || !path.has_extension()) {
    fs::path known = worlds / (path.stem().string() + ".xml");
    if (fs::is_regular_file(known, ignored)) return known;
  }
  return NoSuchWorld(word, XmlNamesIn(worlds));
}

}  // namespace runnel
