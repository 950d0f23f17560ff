#include "core/plugin/module_registry.h"

#include "core/base/nearest_name.h"
#include "core/element/runtime.h"
#include "core/plugin/module_type_name.h"

namespace runnel {

Result<void> ModuleRegistry::Add(ModuleType type) {
  if (type.name.empty() || type.name.find(' ') != std::string::npos) {
    return Error{.message = "'" + type.name + "' cannot be the name of a module type"};
  }
  if (const ModuleType* known = Find(type.name)) {
    return Error{.message = "module type '" + type.name + "' comes with plugin '" + known->plugin +
                            "' already"};
  }
  std::string name = type.name;
  types_.emplace(std::move(name), std::move(type));
  return {};
}

void ModuleRegistry::RemovePlugin(std::string_view plugin) {
  std::erase_if(types_, [&](const auto& entry) { return entry.second.plugin == plugin; });
}

const ModuleType* ModuleRegistry::Find(std::string_view name) const {
  const auto found = types_.find(name);
  return found == types_.end() ? nullptr : &found->second;
}

Result<const ModuleType*> ModuleRegistry::Get(std::string_view name) const {
  if (const ModuleType* type = Find(name)) return type;
  std::vector<std::string> names;
  for (const auto& [each, type] : types_) names.push_back(each);
  return Error{.message = "there is no module type '" + std::string(name) + "'",
               .hint = NearestNameHint(name, names)};
}

std::vector<const ModuleType*> ModuleRegistry::All() const {
  std::vector<const ModuleType*> types;
  for (const auto& [name, type] : types_) types.push_back(&type);
  return types;
}

Result<FrameworkElement*> ModuleRegistry::Create(std::string_view type, FrameworkElement& parent,
                                                 std::string name) const {
  const auto known = Get(type);
  if (!known) return known.error();
  const std::lock_guard lock(parent.runtime().structure_mutex());
  try {
    auto element = (*known)->make({parent, std::move(name)});
    FrameworkElement* const made = element.get();
    made->Annotate(std::make_unique<ModuleTypeName>((*known)->name));
    parent.runtime().Adopt(std::move(element));
    return made;
  } catch (const ElementError& error) {
    return error.error();
  } catch (const std::exception& exception) {
    return Error{.message = "a module of type '" + std::string(type) +
                            "' could not be made: " + exception.what(),
                 .path = parent.path()};
  } catch (...) {
    return Error{.message = "a module of type '" + std::string(type) +
                            "' could not be made: an exception of unknown type",
                 .path = parent.path()};
  }
}

}  // namespace runnel
