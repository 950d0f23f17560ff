#include "plugins/finroc_files/application_form.h"

#include "plugins/finroc_files/finroc_application.h"

namespace runnel {

std::optional<BuildOutcome> FinrocForm::Build(const ApplicationFile& file,
                                              const BuildTools& tools) {
  if (!IsFinrocFile(file.document.root())) return std::nullopt;
  return BuildFinrocApplication(file.document, file.file, tools, BuildMode::kConstruct);
}

}  // namespace runnel
