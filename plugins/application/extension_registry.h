#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/plugin/plugin_registry.h"
#include "plugins/application/application_extension.h"
#include "plugins/application/application_options.h"

namespace runnel {

using Extensions = std::vector<std::shared_ptr<ApplicationExtension>>;

/// What plugins make of their options: one extension, or several that begin in this order. Errors: what is
/// wrong with a value.
using ExtensionFactory = std::function<Result<Extensions>(const ExtensionArguments& arguments)>;

/// The extensions that plugins bring. One of a plugin, by its name:
///
///     RUNNEL_PLUGIN(tracing, registry) {
///       if (auto* extensions = registry.Find<ExtensionRegistry>()) extensions->Add(MakeTrace);
///     }
///
/// Threads: not thread-safe.
class ExtensionRegistry final : public OfferedRegistry {
 public:
  /// Throws ElementError if the plugin has added one already.
  void Add(ExtensionFactory factory);
  std::function<void()> SetAside(std::string_view plugin) override;
  void set_plugin(const std::string& plugin) override { plugin_ = plugin; }

  /// Errors: the plugin is loaded, and has none; what the factory says, or throws.
  [[nodiscard]] Result<Extensions> Make(const std::string& plugin, const ExtensionArguments& arguments) const;

 private:
  std::map<std::string, ExtensionFactory, std::less<>> factories_;
  std::string plugin_;
};

}  // namespace runnel
