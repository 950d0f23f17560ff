#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/plugin/module_registry.h"

namespace runnel {

/// A registry of something other than modules that plugins may add to: derive from it and offer it.
class OfferedRegistry {
 public:
  virtual ~OfferedRegistry() = default;
  /// Takes out all that `plugin` has added: its registration has failed halfway, or it is to be loaded
  /// anew. Calling what is returned puts it back. If it throws, for lack of memory, nothing has been taken out.
  virtual std::function<void()> SetAside(std::string_view plugin) = 0;
  /// What is added from now on counts as of this plugin; "": of none.
  virtual void set_plugin(const std::string& plugin) = 0;
};

/// What a plugin is handed to register itself with: the module types, and whatever other registries
/// the application has put in (the tags of XML files, for one), which the core need not know.
///
/// Threads:  used by the loading thread only.
class PluginRegistry {
 public:
  explicit PluginRegistry(ModuleRegistry& modules) : modules_(&modules) {}

  /// Makes M known as a module type. Throws ElementError if the name is taken; the plugin is
  /// refused then, whole.
  template <typename M>
  void Add(std::string type_name, std::string summary) {
    static_assert(PlaceableElement<M>,
                  "a module type derives from runnel::Module and takes a Placement: "
                  "write `using Module::Module;` in its public part");
    AddType({std::move(type_name), std::move(summary), plugin_,
             [](const Placement& placement) -> std::unique_ptr<FrameworkElement> {
               return std::make_unique<M>(placement);
             }});
  }

  /// Lets plugins reach `registry` by its type. It must outlive this object.
  template <std::derived_from<OfferedRegistry> Registry>
  void Offer(Registry& registry) {
    offered_[typeid(Registry)] = &registry;
  }
  /// nullptr if the application offers none: then the plugin leaves out what would go there.
  template <typename Registry>
  [[nodiscard]] Registry* Find() const {
    const auto found = offered_.find(typeid(Registry));
    return found == offered_.end() ? nullptr : &static_cast<Registry&>(*found->second);
  }

  [[nodiscard]] const std::string& plugin() const noexcept { return plugin_; }

 private:
  friend class PluginManager;
  friend class PluginReload;
  void AddType(ModuleType type) {
    if (auto added = modules_->Add(std::move(type)); !added) throw ElementError(added.error());
  }
  void set_plugin(const std::string& plugin) {
    plugin_ = plugin;
    for (const auto& [type, registry] : offered_) registry->set_plugin(plugin);
  }
  std::function<void()> SetAside(std::string_view plugin) {
    const auto back = std::make_shared<std::vector<std::function<void()>>>();
    back->reserve(offered_.size() + 1);
    std::function<void()> all_back = [back] {
      for (const auto& each : *back) each();
    };
    try {
      back->push_back(modules_->SetAside(plugin));
      for (const auto& [type, registry] : offered_) back->push_back(registry->SetAside(plugin));
    } catch (...) {
      all_back();
      throw;
    }
    return all_back;
  }

  ModuleRegistry* modules_;
  std::map<std::type_index, OfferedRegistry*> offered_;
  std::string plugin_;  // the one that registers now
};

}  // namespace runnel
