#include "plugins/application/extension_registry.h"

#include <utility>

#include "core/base/exception_text.h"

namespace runnel {

void ExtensionRegistry::Add(ExtensionFactory factory) {
  if (!factories_.try_emplace(plugin_, std::move(factory)).second) {
    throw ElementError({.message = "plugin '" + plugin_ + "' adds two extensions"});
  }
}

std::function<void()> ExtensionRegistry::SetAside(std::string_view plugin) {
  const auto aside = std::make_shared<decltype(factories_)>();
  std::function<void()> back = [this, aside] { factories_.merge(*aside); };
  if (const auto found = factories_.find(plugin); found != factories_.end()) {
    aside->insert(factories_.extract(found));
  }
  return back;
}

Result<Extensions> ExtensionRegistry::Make(const std::string& plugin,
                                           const ExtensionArguments& arguments) const {
  const auto found = factories_.find(plugin);
  if (found == factories_.end()) {
    return Error{.message = "the plugin '" + plugin + "' is no extension of applications"};
  }
  try {
    return found->second(arguments);
  } catch (...) {
    return Error{.message =
                     "the extension '" + plugin + "' cannot be made: " + DescribeException()};
  }
}

}  // namespace runnel
