#include <memory>
#include <optional>

#include "core/plugin/plugin_entry.h"
#include "plugins/application/application_extension.h"
#include "plugins/finroc_files/finroc_application.h"

namespace runnel {

namespace {

class FinrocForm final : public ApplicationExtension {
 public:
  std::optional<BuildOutcome> Build(const ApplicationFile* file, const BuildTools& tools) override {
    if (file == nullptr || !IsFinrocFile(file->document.root())) return std::nullopt;
    return BuildFinrocApplication(file->document, file->file, tools, BuildMode::kConstruct);
  }
};

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(finroc_files, registry) {
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add([](const runnel::ExtensionArguments&) -> runnel::Result<runnel::Extensions> {
      return runnel::Extensions{std::make_shared<runnel::FinrocForm>()};
    });
  }
}
