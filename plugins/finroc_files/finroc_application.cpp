#include "plugins/finroc_files/finroc_application.h"

#include <memory>
#include <mutex>

#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "plugins/finroc_files/finroc_names.h"
#include "plugins/finroc_files/finroc_reader.h"

namespace runnel {

namespace {

// What would have fed them may have had no counterpart, which has been told; the rest is built.
void WarnOfRequiredInputs(FrameworkElement& application, const BuildTools& tools, const std::filesystem::path& file,
                          BuildContext& context) {
  Diagnostics missing;
  BuildContext check(tools, file.parent_path(), missing);
  CheckRequiredInputs(application, check);
  for (const Error& error : missing.errors()) context.Warn(error, error.position, application);
}

FrameworkElement* Build(XmlElement root, const std::filesystem::path& file, const BuildTools& tools,
                        BuildContext& context) {
  FrameworkElement* application = nullptr;
  const FrameworkElement& top = tools.runtime.root();
  context.Attempt({"reading the file", root.position(), &top}, [&] {
    const std::string name = RunnelName(root.TextOr("defaultname", file.stem().string()));
    application = &tools.runtime.Create<Group>(tools.runtime.root(), name);
    application->Annotate(std::make_unique<SourcePlace>(root.position()));
    internal::FinrocReader(*application, context).Read(root, file);
  });
  if (application == nullptr) return nullptr;
  WarnOfRequiredInputs(*application, tools, file, context);
  for (const std::string& name : tools.configuration.UnusedArguments()) {
    context.Report({.message = "the application knows no '" + name + "'", .position = {"command line"}}, {},
                   *application);
  }
  return application;
}

}  // namespace

bool IsFinrocFile(XmlElement root) { return root.name() == "Finstructable" || root.name() == "FinstructableGroup"; }

BuildOutcome BuildFinrocApplication(const XmlDocument& document, const std::filesystem::path& file,
                                    const BuildTools& tools, BuildMode mode) {
  BuildOutcome outcome;
  BuildContext context(tools, file.parent_path(), outcome.diagnostics);
  {
    const std::lock_guard lock(tools.runtime.structure_mutex());
    outcome.application = Build(document.root(), file, tools, context);
  }
  FinishBuild(outcome, mode);
  return outcome;
}

}  // namespace runnel
