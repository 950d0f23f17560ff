#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/element/unlisted_element.h"

namespace runnel {

/// A class that can be made from a Placement, as `using Module::Module;` makes it.
template <typename M>
concept PlaceableElement = std::derived_from<M, FrameworkElement> && std::constructible_from<M, const Placement&>;

/// One kind of module that applications can contain.
struct ModuleType {
  std::string name;     ///< "motion/collision_guard"
  std::string summary;  ///< one line
  std::string plugin;   ///< the library that it came with
  std::function<std::unique_ptr<FrameworkElement>(const Placement&)> make;
};

/// The kinds of modules that are known, by name.
///
/// Threads:  not thread-safe; plugins are loaded by one thread, or under the structure lock.
class ModuleRegistry {
 public:
  /// Errors: the name is taken (the message names the plugin that has it) or malformed.
  Result<void> Add(ModuleType type);
  /// Takes out the types of `plugin`. Calling what is returned puts them back, but for those whose name is
  /// taken by then; that needs no memory.
  std::function<void()> SetAside(std::string_view plugin);

  [[nodiscard]] const ModuleType* Find(std::string_view name) const;
  /// The type called `name`, or an error with the nearest name that there is.
  [[nodiscard]] Result<const ModuleType*> Get(std::string_view name) const;
  /// All types, sorted by name.
  [[nodiscard]] std::vector<const ModuleType*> All() const;

  /// Makes a module, which remembers its type (module_type_name.h). Whatever its constructor throws
  /// comes back as an error, and then nothing has changed. If the placement says that it is not listed,
  /// it is beside the tree.
  Result<UnlistedElement> Make(std::string_view type, const Placement& placement) const;
  /// Makes a module and gives it to `parent`. Errors: as Make().
  Result<FrameworkElement*> Create(std::string_view type, FrameworkElement& parent, std::string name) const;

  /// The same just to look at it, with the ports that it has by default. Errors: besides, that these cannot be made;
  /// nothing is left then.
  Result<FrameworkElement*> CreateSample(std::string_view type, FrameworkElement& parent) const;

 private:
  using Types = std::map<std::string, ModuleType, std::less<>>;
  Types types_;
};

/// Says what the type called `name` is, when somebody asks for it the first time. Errors: there is none, with the
/// nearest.
using LateTypeFinder = std::function<Result<ModuleType>(std::string_view name)>;

/// Types of modules of which no plugin has a list, as they are written in another language and found when they are
/// asked for: all whose names begin with `prefix` ("python/"). Of two finders of one prefix the later is asked. Where
/// a registry has a type of the name itself, that counts.
///
/// Threads: any; locks.
void AddLateTypes(std::string prefix, LateTypeFinder find);

namespace internal {

/// The type, which stays in memory. Errors: nobody knows the prefix (an empty message); what the finder says.
[[nodiscard]] Result<const ModuleType*> FindLateType(std::string_view name);

}  // namespace internal

}  // namespace runnel
