#include "plugins/application/application_description.h"

#include <utility>

#include "core/module/group.h"
#include "plugins/application/application_extension.h"
#include "plugins/application_files/run_description.h"

namespace runnel {

namespace {

BuildOutcome Failed(Error error) {
  BuildOutcome outcome;
  outcome.diagnostics.Add(std::move(error));
  return outcome;
}

}  // namespace

ApplicationDescription::ApplicationDescription(ApplicationOptions options)
    : options_(std::move(options)) {
  for (const auto& folder : options_.plugin_folders) plugins_.AddSearchFolder(folder);
  for (const auto& extension : options_.extensions) extension->AddWords(tags_);
  plugins_.registry().Offer(tags_);
}

bool ApplicationDescription::ReadFrom(const Describe& describe) {
  Diagnostics before;
  for (const std::string& each : options_.configurations) configuration_.Load(each, before);
  for (const ApplicationSetting& setting : options_.settings) {
    if (auto added = configuration_.AddArgument(setting.text); !added) before.Add(added.error());
  }
  BuildOutcome outcome = describe({runtime_, plugins_, tags_, configuration_});
  diagnostics_ = std::move(outcome.diagnostics);
  // A mistake there does not keep those in the application file from being told, but from running.
  for (const Error& error : before.errors()) diagnostics_.Add(error);
  if (!before.ok() && outcome.application != nullptr) {
    (void)runtime_.Delete(*std::exchange(outcome.application, nullptr));
  }
  element_ = outcome.application;
  if (element_ == nullptr) return false;
  name_ = element_->name();
  path_ = element_->path();
  return true;
}

BuildOutcome ApplicationDescription::Build(const ApplicationFile& file) {
  const BuildTools tools{runtime_, plugins_, tags_, configuration_};
  for (const auto& extension : options_.extensions) {
    if (auto built = extension->Build(file, tools)) return std::move(*built);
  }
  return BuildApplication(file, tools, BuildMode::kConstruct);
}

bool ApplicationDescription::Read(const std::filesystem::path& file) {
  return ReadFrom([&](const BuildTools&) {
    const auto read = ApplicationFile::Read(file);
    if (!read) return Failed(read.error());
    file_ = std::filesystem::absolute(file).lexically_normal().string();
    text_ = read->text;
    return Build(*read);
  });
}

bool ApplicationDescription::ReadText(std::string_view text, const std::filesystem::path& folder,
                                      const std::string& name) {
  return ReadFrom([&](const BuildTools& tools) {
    const auto document = XmlDocument::Parse(std::string(text), name);
    if (!document) return Failed(document.error());
    text_ = text;
    return BuildApplication(*document, folder, tools, BuildMode::kConstruct);
  });
}

bool ApplicationDescription::MakeEmpty(const std::string& name) {
  return ReadFrom([&](const BuildTools& tools) {
    try {
      return BuildOutcome{&tools.runtime.Create<Group>(tools.runtime.root(), name)};
    } catch (const ElementError& error) {
      return Failed(error.error());
    }
  });
}

}  // namespace runnel
