#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/element/runtime.h"
#include "core/plugin/plugin_manager.h"
#include "plugins/application/application_checks.h"
#include "plugins/application/application_extension.h"
#include "plugins/application/application_options.h"
#include "plugins/application/extension_description.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/parameters/configuration.h"

namespace runnel {

/// What an application is before any of it runs: elements that are constructed, configured and connected, with what
/// the file says of the clock, threads and rules kept at them; and all that is wrong with it. Application makes
/// what runs from it; whoever only looks at a file needs no more than this.
///
///     ApplicationDescription description({.settings = {{"goal_x", "4"}}});
///     if (!description.Read("robot.xml")) Print(description.diagnostics().ToString());
///
/// Ownership:  of the elements, and of what describes them: plugins' types, words, configuration.
/// Threads:    one, until it belongs to an application.
/// Errors:     in the diagnostics, all of a file at once; nothing is left of it then.
class ApplicationDescription {
 public:
  /// Nothing is described yet; the words and types that are there can be asked for.
  explicit ApplicationDescription(ApplicationOptions options = {});
  virtual ~ApplicationDescription() = default;

  // One of these, once. False: it is wrong.

  /// "": what an extension describes without a file.
  bool Read(const std::filesystem::path& file);
  /// Errors call the text `name`; relative file names in it start in `folder`.
  bool ReadText(std::string_view text, const std::filesystem::path& folder, const std::string& name);
  /// An empty group of this name.
  bool MakeEmpty(const std::string& name);
  /// What `describe` constructs, in whichever way.
  using Describe = std::function<BuildOutcome(const BuildTools& tools)>;
  bool ReadFrom(const Describe& describe);

  /// What plugins have to say of the whole (ApplicationChecks), into the diagnostics; a model that is checked also into
  /// `model_file`, if that is not "". Nothing if there are errors.
  void RunChecks(const std::string& model_file = {});

  [[nodiscard]] const Diagnostics& diagnostics() const noexcept { return diagnostics_; }
  /// The group that all is in; nullptr if there are errors.
  [[nodiscard]] FrameworkElement* element() const noexcept { return element_; }
  /// Its name and path, also when it has been deleted.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// What it came from, absolute, and what that said; "" if from no file.
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

  [[nodiscard]] const ApplicationOptions& options() const noexcept { return options_; }
  /// Those of the options, those that are named there, and those of the file's words.
  [[nodiscard]] const Extensions& extensions() const noexcept { return extensions_; }
  [[nodiscard]] Runtime& runtime() noexcept { return runtime_; }
  [[nodiscard]] PluginManager& plugins() noexcept { return plugins_; }
  [[nodiscard]] XmlTagRegistry& tags() noexcept { return tags_; }

 protected:
  /// Loads the plugin of an extension, unless it is there. `need` is what asks for it: "--trace". Errors: it is not
  /// installed; it knows no such option; what is wrong with a value.
  Result<Extensions> MakeExtensions(const ExtensionDescription& extension, const std::string& need,
                                    const ExtensionArguments& arguments);

  Diagnostics diagnostics_;
  FrameworkElement* element_ = nullptr;

 private:
  BuildOutcome Build(const ApplicationFile* file);
  // Before anything is made: what publishes in its constructor does so at the application's time.
  void BeginTime(bool is_simulated);
  // Reads it when it is first asked for.
  Result<const ExtensionCatalogue*> Catalogue();
  // Loads the plugin of an extension and attaches what it makes of the arguments.
  Result<void> Attach(const ExtensionDescription& extension, const std::string& need,
                      const ExtensionArguments& arguments);
  Result<void> AttachByName(const ExtensionByName& extension);
  // Likewise, if an extension has this word of application files.
  Result<void> AttachForTag(std::string_view tag);

  const ApplicationOptions options_;
  std::string name_;
  std::string path_;
  std::string file_;
  std::string text_;
  PluginManager plugins_;
  XmlTagRegistry tags_;
  ExtensionRegistry extension_registry_;
  ApplicationChecks checks_;
  std::optional<ExtensionCatalogue> catalogue_;
  Configuration configuration_;
  Extensions extensions_;
  std::set<std::string> attached_;  // their names
  ManualClock beginning_;           // of simulated time, until the scheduler brings its clock
  Runtime runtime_;                 // last, for modules may still use what plugins gave them
};

}  // namespace runnel
