#include "apps/runnel/workplace.h"

#include <iostream>

#include "plugins/finroc_files/finroc_application.h"
#include "plugins/inspector/xml_inspector_tag.h"
#include "plugins/scheduling_tags/xml_scheduling_tags.h"
#include "plugins/supervision/xml_supervision_tags.h"

namespace runnel::program {

namespace {

// Of Runnel or of FINROC; what is wrong with the file itself, the first of these says.
BuildOutcome BuildFile(const std::string& file, const BuildTools& tools, BuildMode mode) {
  const auto text = XmlDocument::ReadText(file);
  if (text && text->find("<Finstructable") != std::string::npos) {
    const auto document = XmlDocument::Parse(*text, file);
    if (document && IsFinrocFile(document->root())) {
      return BuildFinrocApplication(*document, file, tools, mode);
    }
  }
  return BuildApplication(file, tools, mode);
}

}  // namespace

Workplace::Workplace() {
  AddSchedulingTags(tags_);
  AddSupervisionTags(tags_);
  AddInspectorTag(tags_);
  plugins_.registry().Offer(tags_);
}

void Workplace::ReadConfiguration(const ApplicationArguments& arguments, Diagnostics& diagnostics) {
  for (const std::string& file : arguments.configurations) configuration_.Load(file, diagnostics);
  for (const std::string& setting : arguments.settings) {
    if (auto added = configuration_.AddArgument(setting); !added) diagnostics.Add(added.error());
  }
}

BuildOutcome Workplace::Build(const ApplicationArguments& arguments, BuildMode mode,
                              BeforeReady before_ready) {
  Diagnostics before;
  ReadConfiguration(arguments, before);
  // A mistake there does not keep those in the application file from being told, but from running.
  if (!before.ok()) mode = BuildMode::kCheck;
  BuildOutcome outcome = BuildFile(
      arguments.file, {runtime_, plugins_, tags_, configuration_, std::move(before_ready)}, mode);
  for (const Error& error : before.errors()) outcome.diagnostics.Add(error);
  std::cerr << outcome.diagnostics.ToString();
  return outcome;
}

}  // namespace runnel::program
