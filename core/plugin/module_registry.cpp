#include "core/plugin/module_registry.h"

#include <mutex>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/element/runtime.h"
#include "core/plugin/module_type_name.h"

namespace runnel {

namespace {

struct LateTypes {
  std::mutex mutex;  // a leaf, but for what finders lock
  std::map<std::string, LateTypeFinder, std::less<>> finders;
  // Of all finders there ever were: who has been told of a type may keep the pointer.
  std::map<std::string, ModuleType, std::less<>> known;
};

LateTypes& Late() {
  static auto* const late = new LateTypes;  // plugins' code may ask until the very end
  return *late;
}

}  // namespace

void AddLateTypes(std::string prefix, LateTypeFinder find) {
  const std::lock_guard lock(Late().mutex);
  Late().finders.insert_or_assign(std::move(prefix), std::move(find));
}

Result<const ModuleType*> internal::FindLateType(std::string_view name) {
  LateTypes& late = Late();
  LateTypeFinder find;
  {
    const std::lock_guard lock(late.mutex);
    if (const auto known = late.known.find(name); known != late.known.end()) return &known->second;
    for (const auto& [prefix, finder] : late.finders) {
      if (name.starts_with(prefix)) find = finder;
    }
  }
  if (!find) return Error{};
  auto found = find(name);
  if (!found) return found.error();
  const std::lock_guard lock(late.mutex);
  return &late.known.try_emplace(std::string(name), std::move(*found)).first->second;
}

Result<void> ModuleRegistry::Add(ModuleType type) {
  if (type.name.empty() || type.name.find(' ') != std::string::npos) {
    return Error{.message = "'" + type.name + "' cannot be the name of a module type"};
  }
  if (const ModuleType* known = Find(type.name)) {
    return Error{.message = "module type '" + type.name + "' comes with plugin '" + known->plugin + "' already"};
  }
  std::string name = type.name;
  types_.emplace(std::move(name), std::move(type));
  return {};
}

std::function<void()> ModuleRegistry::SetAside(std::string_view plugin) {
  // All memory comes before the first type is taken out, and putting them back needs none.
  const auto aside = std::make_shared<std::vector<Types::node_type>>();
  aside->reserve(types_.size());
  std::function<void()> back = [this, aside] {
    for (Types::node_type& type : *aside) types_.insert(std::move(type));
    aside->clear();
  };
  for (auto each = types_.begin(); each != types_.end();) {
    const auto at = each++;
    if (at->second.plugin == plugin) aside->push_back(types_.extract(at));
  }
  return back;
}

const ModuleType* ModuleRegistry::Find(std::string_view name) const {
  const auto found = types_.find(name);
  if (found != types_.end()) return &found->second;
  const auto late = internal::FindLateType(name);
  return late ? *late : nullptr;
}

Result<const ModuleType*> ModuleRegistry::Get(std::string_view name) const {
  if (const ModuleType* type = Find(name)) return type;
  if (const auto late = internal::FindLateType(name); !late && !late.error().message.empty()) return late.error();
  return Error{.message = "there is no module type '" + std::string(name) + "'",
               .hint = NearestNameHint(name, NamesOf(types_, &Types::value_type::first))};
}

std::vector<const ModuleType*> ModuleRegistry::All() const {
  std::vector<const ModuleType*> types;
  for (const auto& [name, type] : types_) types.push_back(&type);
  return types;
}

Result<UnlistedElement> ModuleRegistry::Make(std::string_view type, const Placement& placement) const {
  // A copy: the plugin may be loaded anew while its module is made.
  ModuleType known;
  {
    const std::lock_guard lock(placement.parent.runtime().structure_mutex());
    const auto found = Get(type);
    if (!found) return found.error();
    known = **found;
  }
  std::unique_lock lock(placement.parent.runtime().structure_mutex(), std::defer_lock);
  if (placement.is_listed) lock.lock();
  try {
    UnlistedElement element(known.make(placement));
    element->Annotate(std::make_unique<ModuleTypeName>(known.name));
    return element;
  } catch (const ElementError& error) {
    return error.error();
  } catch (...) {
    return CaughtError("a module of type '", type, "' could not be made: ").WithPath(placement.parent.path());
  }
}

Result<FrameworkElement*> ModuleRegistry::Create(std::string_view type, FrameworkElement& parent,
                                                 std::string name) const {
  Runtime& runtime = parent.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  auto made = Make(type, {parent, std::move(name)});
  if (!made) return made.error();
  return runtime.Adopt(std::move(*made));
}

Result<FrameworkElement*> ModuleRegistry::CreateSample(std::string_view type, FrameworkElement& parent) const {
  const std::lock_guard lock(parent.runtime().structure_mutex());
  auto made = Make(type, {parent, "module_" + std::to_string(parent.children().size()), false});
  if (!made) return made.error();
  if (auto constructed = Runtime::Construct(**made); !constructed) return constructed.error();
  return parent.runtime().List(std::move(*made));
}

}  // namespace runnel
