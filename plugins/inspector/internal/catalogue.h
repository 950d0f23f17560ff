#pragma once

#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "plugins/command_service/command_service.h"

namespace runnel::internal {

/// A port as a module type has it.
struct CatalogueItemPort {
  std::string name;
  bool is_input = false;
  std::string type;

  friend bool operator==(const CatalogueItemPort&, const CatalogueItemPort&) = default;
};

/// What modules of a type look like.
struct CatalogueItem {
  std::string type;
  std::string summary;
  std::vector<CatalogueItemPort> ports;
  std::string json;  ///< as the protocol has it
};

struct Catalogue {
  std::vector<CatalogueItem> modules;
  std::string message;  ///< of the protocol, with all modules and types
};

/// All module types, as the manifests of their plugins describe them; where there is none, by making a module
/// beside the tree, under the structure lock, which is let go between any two. Types whose modules cannot be made
/// have no ports in it, and "problem" says why.
///
/// Threads:  one that may wait.
[[nodiscard]] Catalogue MakeCatalogue(const ServedApplication& application);

/// Another number if other module types, or types of values, are registered. Under the structure lock.
[[nodiscard]] std::uint64_t RegistryFingerprint(const ModuleRegistry& modules);

/// The types that could stand in for the module at `path`, as a JSON list: those that take over all of
/// its connections first, then those that lose the fewest; each with "lost", the names of ports whose
/// connections would go. Those that keep none are left out. Errors: there is no such module.
[[nodiscard]] Result<std::string> CompatibleTypes(Runtime& runtime, const Catalogue& catalogue,
                                                  const std::string& path);

}  // namespace runnel::internal
