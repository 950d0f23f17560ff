#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"

namespace runnel::arena {

/// Folders of the product: those of the install tree that the program stands in, or of the sources
/// that it has been built from.
struct Product {
  std::filesystem::path program;       ///< runnel, beside this one
  std::filesystem::path applications;  ///< xml/apps/arena: one for each sensor
};
[[nodiscard]] Product FindProduct();

/// Which plugin of Runnel's a module type is from.
[[nodiscard]] std::string PluginOf(std::string_view type);

/// A planner to be compared.
struct Variant {
  std::string name;             ///< in tables: "bug1"
  std::string type;             ///< of the module: "planning/bug1"
  std::string parameters = {};  ///< <parameter> tags, as they stand in an application
};

/// The variants that the words name. `types`: all module types there are. Errors are added.
[[nodiscard]] std::vector<Variant> FindVariants(const std::vector<std::string>& words,
                                                const std::vector<std::string>& types, Diagnostics& diagnostics);

/// The names of all module types of the product's planners and of others' plugins. Errors: a plugin
/// that cannot be loaded.
[[nodiscard]] std::vector<std::string> FindTypes(const std::vector<std::string>& plugins, Diagnostics& diagnostics);

/// Complains about each word that is not among `known`.
void CheckNames(const std::vector<std::string>& words, const std::vector<std::string>& known, const std::string& what,
                Diagnostics& diagnostics);

/// The application of a sensor with another planner in the place of the one that stands in it, and
/// with the plugins loaded that the planner may be from. Errors: the file cannot be read, or has
/// not exactly one place for the planner and for plugins.
[[nodiscard]] Result<std::string> ApplicationText(const std::filesystem::path& file, const Variant& variant,
                                                  const std::vector<std::string>& plugins);

/// What is in the file. Errors: it cannot be read.
[[nodiscard]] Result<std::string> ReadFile(const std::filesystem::path& file);
/// Replaces it whole or, on an error, not at all: by way of a file beside it.
Result<void> WriteFile(const std::filesystem::path& file, std::string_view text);

}  // namespace runnel::arena
