#include "plugins/runtime_construction/application_builder.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/nearest_name.h"
#include "plugins/runtime_construction/application_reader.h"
#include "plugins/runtime_construction/application_source.h"
#include "plugins/runtime_construction/required_inputs.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

namespace {

void CollectValues(XmlElement element, std::string_view attribute,
                   std::vector<std::string>& values) {
  if (const XmlAttribute* found = element.Attribute(attribute)) values.push_back(found->value);
  for (const XmlElement child : element.children()) CollectValues(child, attribute, values);
}

// Names on the command line that nothing in the file knows. What stands in the file counts even if
// its parameter could not be made, for that has been reported.
void ReportUnknownArguments(XmlElement root, const PartFiles& parts,
                            const Configuration& configuration, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  CollectValues(root, "command_line", known);
  for (const XmlElement part : parts.Roots()) CollectValues(part, "command_line", known);
  for (const std::string& name : configuration.UnusedArguments()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    diagnostics.Add({.message = "the application knows no '" + name + "'",
                     .position = {.file = "command line"},
                     .hint = NearestNameHint(name, known)});
  }
}

void MakeReady(FrameworkElement& application, const BuildTools& tools, BuildContext& context) {
  if (tools.before_ready) {
    const SourcePosition position = FindSourcePlace(application);
    context.Attempt({"preparing the run", position, &application}, [&] {
      const auto prepared = tools.before_ready(application);
      if (!prepared) context.Report(prepared.error(), position, application);
    });
    if (!context.ok()) return;
  }
  Runtime& runtime = context.runtime();
  const auto ready = runtime.MakeReady(application);
  if (ready) return;
  const auto culprit = runtime.root().Find(ready.error().path);
  const FrameworkElement& at = culprit ? **culprit : application;
  context.Report(ready.error(), FindSourcePlace(at), at);
}

// The text that the application came from, if it came from a file.
struct SourceText {
  std::filesystem::path file;
  std::string text;
};

FrameworkElement* Build(XmlElement root, const BuildTools& tools, BuildContext& context,
                        BuildMode mode, Diagnostics& diagnostics) {
  ApplicationReader reader(context);  // what it defers needs it still
  FrameworkElement* const application = reader.Read(root);
  context.RunDeferred();
  if (application != nullptr) CheckRequiredInputs(*application, context);
  ReportUnknownArguments(root, context.parts(), tools.configuration, diagnostics);
  if (diagnostics.ok() && mode == BuildMode::kRun) MakeReady(*application, tools, context);
  return application;
}

void KeepSource(FrameworkElement& application, SourceText text, BuildContext& context) {
  auto source = std::make_unique<ApplicationSource>();
  source->file = std::move(text.file);
  source->text = std::move(text.text);
  source->values = context.TakeValues();
  source->parts = context.parts().TakeTexts();
  application.Annotate(std::move(source));
}

BuildOutcome BuildFrom(const XmlDocument& document, const std::filesystem::path& folder,
                       std::optional<SourceText> text, const BuildTools& tools, BuildMode mode) {
  BuildOutcome outcome;
  BuildContext context(tools, folder, outcome.diagnostics);
  {
    const std::lock_guard lock(tools.runtime.structure_mutex());
    outcome.application = Build(document.root(), tools, context, mode, outcome.diagnostics);
    if (outcome.application != nullptr && text) {
      KeepSource(*outcome.application, std::move(*text), context);
    }
  }
  if (outcome.application == nullptr) return outcome;
  if (!outcome.diagnostics.ok() || mode == BuildMode::kCheck) {
    // Outside of the lock, for deleting waits for cycles, which may be waiting for the lock.
    const auto deleted = tools.runtime.Delete(*std::exchange(outcome.application, nullptr));
    if (!deleted) outcome.diagnostics.Add(deleted.error());
  }
  return outcome;
}

}  // namespace

BuildOutcome BuildApplication(const XmlDocument& document, const std::filesystem::path& folder,
                              const BuildTools& tools, BuildMode mode) {
  return BuildFrom(document, folder, std::nullopt, tools, mode);
}

BuildOutcome BuildApplication(const std::filesystem::path& file, const BuildTools& tools,
                              BuildMode mode) {
  BuildOutcome failed;
  auto text = XmlDocument::ReadText(file);
  if (!text) {
    failed.diagnostics.Add(text.error());
    return failed;
  }
  const auto document = XmlDocument::Parse(*text, file.string());
  if (!document) {
    failed.diagnostics.Add(document.error());
    return failed;
  }
  return BuildFrom(*document, file.parent_path(), SourceText{file, std::move(*text)}, tools, mode);
}

}  // namespace runnel
