#include "plugins/application/application_description.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/module/group.h"
#include "plugins/application_tags/application_tags.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

namespace {

BuildOutcome Failed(Error error) {
  BuildOutcome outcome;
  outcome.diagnostics.Add(std::move(error));
  return outcome;
}

Result<void> CheckOptions(const ExtensionDescription& extension, const ExtensionArguments& arguments) {
  const std::vector<std::string> known = NamesOf(extension.options, &ExtensionOption::name);
  for (const auto& [name, value] : arguments.values) {
    if (std::ranges::find(known, name) != known.end()) continue;
    return Error{.message = "the extension '" + extension.name + "' has no option '" + name + "'",
                 .hint = NearestNameHint(name, known)};
  }
  return {};
}

}  // namespace

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

Result<Extensions> ExtensionRegistry::Make(const std::string& plugin, const ExtensionArguments& arguments) const {
  const auto found = factories_.find(plugin);
  if (found == factories_.end()) {
    return Error{.message = "the plugin '" + plugin + "' is no extension of applications"};
  }
  return Attempt([&] { return found->second(arguments); }, "the extension '", plugin, "' cannot be made: ");
}

ApplicationDescription::ApplicationDescription(ApplicationOptions options)
    : options_(std::move(options)), tags_(ApplicationTags()), extensions_(options_.extensions) {
  for (const auto& folder : options_.plugin_folders) plugins_.AddSearchFolder(folder);
  tags_.set_source([this](std::string_view tag) { return AttachForTag(tag); });
  plugins_.registry().Offer(tags_);
  plugins_.registry().Offer(extension_registry_);
  plugins_.registry().Offer(checks_);
}

Result<Extensions> ApplicationDescription::MakeExtensions(const ExtensionDescription& extension,
                                                          const std::string& need,
                                                          const ExtensionArguments& arguments) {
  if (auto known = CheckOptions(extension, arguments); !known) return known.error();
  const std::vector<std::string> there = plugins_.Available();
  if (std::ranges::find(there, extension.name) == there.end()) {
    return Error{.message = need + " needs the extension '" + extension.name + "', which is not installed",
                 .hint = "it " + extension.summary};
  }
  if (auto loaded = plugins_.Load(extension.name); !loaded) return loaded.error();
  return extension_registry_.Make(extension.name, arguments);
}

Result<void> ApplicationDescription::Attach(const ExtensionDescription& extension, const std::string& need,
                                            const ExtensionArguments& arguments) {
  auto made = MakeExtensions(extension, need, arguments);
  if (!made) return made.error();
  extensions_.insert(extensions_.end(), made->begin(), made->end());
  attached_.insert(extension.name);
  return {};
}

Result<const ExtensionCatalogue*> ApplicationDescription::Catalogue() {
  if (catalogue_) return &*catalogue_;
  auto read = ExtensionCatalogue::Read(plugins_.search_path());
  if (!read) return read.error();
  return &catalogue_.emplace(std::move(*read));
}

Result<void> ApplicationDescription::AttachByName(const ExtensionByName& extension) {
  const auto catalogue = Catalogue();
  if (!catalogue) return catalogue.error();
  const ExtensionDescription* const known = (*catalogue)->Find(extension.name);
  if (known == nullptr) {
    return Error{.message = "there is no extension '" + extension.name + "'",
                 .hint = NearestNameHint(extension.name, NamesOf((*catalogue)->all(), &ExtensionDescription::name))};
  }
  const auto& values = extension.arguments.values;
  return Attach(*known, values.empty() ? "this" : "--" + values.front().first, extension.arguments);
}

Result<void> ApplicationDescription::AttachForTag(std::string_view tag) {
  const auto catalogue = Catalogue();
  if (!catalogue) return catalogue.error();
  const ExtensionDescription* const known = (*catalogue)->FindTag(tag);
  if (known == nullptr || attached_.contains(known->name)) return {};
  return Attach(*known, "<" + std::string(tag) + ">", {});
}

void ApplicationDescription::BeginTime(bool is_simulated) {
  if (options_.clock) is_simulated = *options_.clock == SchedulerOptions::ClockKind::kSimulated;
  if (is_simulated) runtime_.set_clock(beginning_);
}

bool ApplicationDescription::ReadFrom(const Describe& describe) {
  BeginTime(false);
  Diagnostics before;
  for (const std::string& each : options_.configurations) configuration_.Load(each, before);
  for (const ApplicationSetting& setting : options_.settings) {
    if (auto added = configuration_.AddArgument(setting.text); !added) before.Add(added.error());
  }
  for (const ExtensionByName& each : options_.extensions_by_name) {
    if (auto attached = AttachByName(each); !attached) before.Add(attached.error());
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

BuildOutcome ApplicationDescription::Build(const ApplicationFile* file) {
  const BuildTools tools{runtime_, plugins_, tags_, configuration_};
  if (file != nullptr) {
    if (auto brought = tags_.Bring(file->document.root().name()); !brought) {
      Error error = brought.error();
      error.position = file->document.root().position();
      return Failed(std::move(error));
    }
  }
  for (const auto& extension : extensions_) {
    if (auto built = extension->Build(file, tools)) return std::move(*built);
  }
  if (file == nullptr) return Failed({.message = "there is no application file"});
  return BuildApplication(*file, tools, BuildMode::kConstruct);
}

bool ApplicationDescription::Read(const std::filesystem::path& file) {
  return ReadFrom([&](const BuildTools&) {
    if (file.empty()) return Build(nullptr);
    const auto read = ApplicationFile::Read(file);
    if (!read) return Failed(read.error());
    file_ = std::filesystem::absolute(file).lexically_normal().string();
    text_ = read->text;
    BeginTime(LivesInSimulatedTime(read->document.root()));
    return Build(&*read);
  });
}

bool ApplicationDescription::ReadText(std::string_view text, const std::filesystem::path& folder,
                                      const std::string& name) {
  return ReadFrom([&](const BuildTools& tools) {
    const auto document = XmlDocument::Parse(std::string(text), name);
    if (!document) return Failed(document.error());
    text_ = text;
    BeginTime(LivesInSimulatedTime(document->root()));
    return BuildApplication(*document, folder, tools, BuildMode::kConstruct);
  });
}

void ApplicationDescription::RunChecks(const std::string& model_file) {
  if (element_ == nullptr) return;
  checks_.Run({*element_, diagnostics_, model_file});
  const std::lock_guard lock(runtime_.structure_mutex());
  element_->Visit([this](FrameworkElement& each) {
    if (dynamic_cast<PreparesAnywhere*>(&each) == nullptr) return;
    if (const auto good = MakeReady(*element_, each); !good) diagnostics_.Add(good.error());
  });
}

bool ApplicationDescription::MakeEmpty(const std::string& name) {
  return ReadFrom([&](const BuildTools& tools) {
    const auto made =
        Attempt([&]() -> Result<Group*> { return &tools.runtime.Create<Group>(tools.runtime.root(), name); });
    return made ? BuildOutcome{*made} : Failed(made.error());
  });
}

}  // namespace runnel
