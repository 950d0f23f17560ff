#include "plugins/application_files/saving/saving.h"

#include <algorithm>

#include "core/base/characters.h"
#include "core/element/not_saved.h"
#include "core/plugin/module_type_name.h"
#include "plugins/parameters/file_path.h"

namespace runnel::internal {

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

void Saving::CheckAttribute(const AttributeRule& rule, const std::string& value,
                            const FrameworkElement& element) {
  CheckText(value, element);
  if (rule.kind != AttributeKind::kModuleType) return;
  if (value.empty()) {
    Fail({.message = "this module was made by code, of a class that no file can name",
          .path = element.path(),
          .hint = "register its type, and make it by ModuleRegistry::Create()"});
  }
  const ModuleType* const type = tools.plugins.modules().Find(value);
  if (type == nullptr) return;
  const std::vector<std::string>& loaded = tools.plugins.loaded();
  // Types that the program itself has brought need no plugin.
  if (std::ranges::find(loaded, type->plugin) != loaded.end()) plugins.insert(type->plugin);
}

bool HoldsOnlyThreads(const FrameworkElement& group) {
  const auto is_thread = [](const FrameworkElement* child) {
    return child->kind() == ElementKind::kThread;
  };
  return !group.children().empty() && std::ranges::all_of(group.children(), is_thread);
}

bool IsSaved(const FrameworkElement& element) {
  if (element.FindAnnotation<NotSaved>() != nullptr) return false;
  return IsModule(element) || (element.kind() == ElementKind::kGroup && !HoldsOnlyThreads(element));
}

}  // namespace runnel::internal
