#include <memory>

#include "core/plugin/plugin_entry.h"
#include "plugins/application/extension_registry.h"
#include "plugins/tracing/application_trace.h"

namespace runnel {

namespace {

Result<Extensions> MakeTrace(const ExtensionArguments& arguments) {
  const std::string file = arguments.Find("trace");
  if (file.empty()) return Error{.message = "--trace: '' is not the name of a file"};
  return Extensions{std::make_shared<ApplicationTrace>(file)};
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(tracing, registry) {
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeTrace);
  }
}
