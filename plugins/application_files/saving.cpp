#include "plugins/application_files/saving.h"

#include <algorithm>

#include "core/base/characters.h"
#include "plugins/parameters/file_path.h"

namespace runnel::internal {

namespace fs = std::filesystem;

std::string MovedFileName(const std::string& name, const fs::path& from, const fs::path& to) {
  if (name.empty() || fs::path(name).is_absolute()) return name;
  std::error_code error;
  const fs::path file = fs::weakly_canonical(fs::absolute(from / name, error), error);
  const fs::path folder = fs::weakly_canonical(fs::absolute(to, error), error);
  const fs::path moved = file.lexically_relative(folder);
  return error || moved.empty() ? name : moved.string();
}

std::string SavedValue(const Configurable& configurable, const Saving& saving) {
  const std::string text = configurable.ToText();
  if (&configurable.type() != &TypeOf<FilePath>()) return text;
  return MovedFileName(text, "", saving.folder);
}

void Saving::CheckText(std::string_view text, const FrameworkElement& element) {
  const std::string fault = UnwritableCharacter(text);
  if (fault.empty()) return;
  Fail({.message = "what is to be saved of it contains " + fault + ": no file can carry that",
        .path = element.path()});
}

void UseModuleType(const std::string& type, Saving& saving) {
  const ModuleType* const known = saving.tools.plugins.modules().Find(type);
  if (known == nullptr) return;
  const std::vector<std::string>& loaded = saving.tools.plugins.loaded();
  // Types that the program itself has brought need no plugin.
  if (std::ranges::find(loaded, known->plugin) != loaded.end()) {
    saving.plugins.insert(known->plugin);
  }
}

}  // namespace runnel::internal
