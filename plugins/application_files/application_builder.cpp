#include "plugins/application_files/application_builder.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/file_notes.h"
#include "core/paths/late_connections.h"
#include "core/paths/new_feeds.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/application_files/part_files.h"
#include "plugins/parameters/configuration_saver.h"

namespace runnel {

namespace {

void CollectValues(XmlElement element, std::string_view attribute, std::vector<std::string>& values) {
  if (const XmlAttribute* found = element.Attribute(attribute)) values.push_back(found->value);
  for (const XmlElement child : element.children()) CollectValues(child, attribute, values);
}

// Names on the command line that nothing in the file knows. What stands in the file counts even if
// its parameter could not be made, for that has been reported.
void ReportUnknownArguments(XmlElement root, const PartFiles& parts, const Configuration& configuration,
                            Diagnostics& diagnostics) {
  std::vector<std::string> known;
  CollectValues(root, "command_line", known);
  for (const XmlElement part : parts.Roots()) CollectValues(part, "command_line", known);
  for (const std::string& name : configuration.UnusedArguments()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    diagnostics.Add({.message = "the application knows no '" + name + "'",
                     .position = {"command line"},
                     .hint = NearestNameHint(name, known)});
  }
}

FrameworkElement* Build(XmlElement root, const BuildTools& tools, BuildContext& context, Diagnostics& diagnostics) {
  FrameworkElement* const application = ReadApplication(root, context);
  context.RunDeferred();
  if (application != nullptr) CheckRequiredInputs(*application, context);
  ReportUnknownArguments(root, context.parts(), tools.configuration, diagnostics);
  return application;
}

void KeepSource(FrameworkElement& application, const ApplicationFile& file, BuildContext& context) {
  auto source = std::make_unique<ApplicationSource>();
  source->file = file.file;
  source->text = file.text;
  source->parts = context.parts().TakeTexts();
  application.Annotate(std::move(source));
}

BuildOutcome BuildFrom(const XmlDocument& document, const std::filesystem::path& folder, const ApplicationFile* file,
                       const BuildTools& tools, BuildMode mode) {
  BuildOutcome outcome;
  NewFeeds feeds(tools.runtime);
  BuildContext context(tools, folder, outcome.diagnostics);
  {
    const std::lock_guard lock(tools.runtime.structure_mutex());
    outcome.application = Build(document.root(), tools, context, outcome.diagnostics);
    if (outcome.application != nullptr && file != nullptr) {
      KeepSource(*outcome.application, *file, context);
      outcome.application->FindOrAnnotate<ConfigurationSource>().files = tools.configuration.files();
    }
  }
  FinishBuild(outcome, mode);
  if (outcome.application != nullptr) feeds.KeepAll();
  return outcome;
}

constexpr std::size_t kMostOutputsNamed = 3;

std::string Hint(const Port& input, FrameworkElement& application) {
  std::vector<std::string> outputs;
  application.VisitAll<const Port>([&](const Port& port) {
    if (port.is_proxy()) return;
    if (port.direction() != Port::Direction::kOutput || &port.type() != &input.type()) return;
    if (outputs.size() < kMostOutputsNamed) outputs.push_back(port.path());
  });
  const std::string type = input.type().name();
  if (outputs.empty()) return "the application has no output of type " + type;
  std::string hint = "connect it to an output of type " + type + ", like ";
  for (std::size_t i = 0; i < outputs.size(); ++i) hint += (i > 0 ? ", " : "") + outputs[i];
  return hint;
}

}  // namespace

Result<void> MakeApplicationReady(FrameworkElement& application) { return MakeReady(application, application); }

Result<void> MakeReady(FrameworkElement& application, FrameworkElement& element) {
  Runtime& runtime = application.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  const auto ready = runtime.MakeReady(element);
  if (ready) return {};
  const auto culprit = runtime.root().Find(ready.error().path);
  const FrameworkElement& at = culprit ? **culprit : application;
  Error error = ready.error().WithPath(at.path()).WithPosition(FindSourcePlace(at));
  const std::string chain = UseChain(error.position.file, at);
  if (!chain.empty()) error.hint += (error.hint.empty() ? "" : "; ") + chain;
  return error;
}

void FinishBuild(BuildOutcome& outcome, BuildMode mode) {
  if (outcome.application == nullptr) return;
  if (outcome.diagnostics.ok() && mode == BuildMode::kRun) {
    if (auto ready = MakeApplicationReady(*outcome.application); !ready) {
      outcome.diagnostics.Add(ready.error());
    }
  }
  if (outcome.diagnostics.ok() && mode != BuildMode::kCheck) return;
  // Outside of the lock, for deleting waits for cycles, which may be waiting for the lock.
  FrameworkElement& application = *std::exchange(outcome.application, nullptr);
  const auto deleted = application.runtime().Delete(application);
  if (!deleted) outcome.diagnostics.Add(deleted.error());
}

BuildOutcome BuildApplication(const XmlDocument& document, const std::filesystem::path& folder, const BuildTools& tools,
                              BuildMode mode) {
  return BuildFrom(document, folder, nullptr, tools, mode);
}

BuildOutcome BuildApplication(const ApplicationFile& file, const BuildTools& tools, BuildMode mode) {
  return BuildFrom(file.document, file.file.parent_path(), &file, tools, mode);
}

BuildOutcome BuildApplication(const std::filesystem::path& file, const BuildTools& tools, BuildMode mode) {
  auto read = ApplicationFile::Read(file);
  if (read) return BuildApplication(*read, tools, mode);
  BuildOutcome failed;
  failed.diagnostics.Add(read.error());
  return failed;
}

void CheckRequiredInputs(FrameworkElement& application, BuildContext& context) {
  std::vector<Port*> unconnected;
  application.VisitAll<Port>([&](Port& port) {
    if (!port.is_required() || !port.Sources().empty() || LateConnections::Awaits(port)) return;
    if (context.IsUnfedUnnoticed(port)) unconnected.push_back(&port);
  });
  for (Port* port : unconnected) {
    context.Report(
        {.message = "nothing is connected to this input, which its module requires", .hint = Hint(*port, application)},
        FindSourcePlace(*port), *port);
  }
}

}  // namespace runnel
