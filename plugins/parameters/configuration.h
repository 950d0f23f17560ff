#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// Values from outside the application file: a configuration file, which several applications may
/// share, and the command line.
///
///     <configuration>
///       <section name="safety">
///         <value name="stop_distance">0.25</value>     <!-- /safety/stop_distance -->
///       </section>
///     </configuration>
///
/// A configuration file of FINROC, `<root>` with `<node name="…">` for sections, is read as well; what
/// is not understood in it is a warning.
///
/// A parameter takes its value from the command line if it is named there, else from the
/// configuration file, else from the application file, else its default.
///
/// Threads: not thread-safe.
class Configuration {
 public:
  struct Entry {
    std::string text;
    SourcePosition position;
    bool used = false;
  };

  /// Adds what the file says; of two files that name a value, the later wins. Errors go to
  /// `diagnostics`, all of them; then nothing has been added.
  void Load(const std::string& file, Diagnostics& diagnostics);
  /// What has been loaded, in the order of loading.
  struct File {
    std::string name;
    std::string text;  ///< byte for byte
  };
  [[nodiscard]] const std::vector<File>& files() const noexcept { return files_; }
  /// Adds "name=value". Errors: no '=', no name, given twice.
  Result<void> AddArgument(std::string_view argument);

  /// The entry of a configuration file, by its path ("/safety/stop_distance"); nullptr if none.
  [[nodiscard]] const Entry* FindEntry(std::string_view path);
  /// The argument of the command line, by its name; nullptr if none.
  [[nodiscard]] const Entry* FindArgument(std::string_view name);

  /// Arguments that nothing has asked for are typing errors: their names.
  [[nodiscard]] std::vector<std::string> UnusedArguments() const;
  /// All paths of the configuration file, for hints.
  [[nodiscard]] std::vector<std::string> EntryPaths() const;

 private:
  std::map<std::string, Entry, std::less<>> entries_;
  std::map<std::string, Entry, std::less<>> arguments_;
  std::vector<File> files_;
};

/// Kept with a parameter that an entry of the configuration sets, or its tag says so: which one. It stays when
/// something round it gets another name.
struct ConfigurationEntry final : Annotation {
  explicit ConfigurationEntry(std::string entry) : path(std::move(entry)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<ConfigurationEntry>(path);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string path;  ///< "/safety/distance"
};

/// Kept with a module or group: what of the configuration is for all parameters within.
struct ConfigurationSection final : Annotation {
  ConfigurationSection(std::string section, std::string as_said) : path(std::move(section)), said(std::move(as_said)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<ConfigurationSection>(path, said);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string path;  ///< "/car/left"
  std::string said;  ///< how the file has it: "left", in the section "/car"

  /// nullptr: there is none.
  [[nodiscard]] static const FrameworkElement* FindAround(const FrameworkElement& element);
};

/// The entry by the section round the parameter, as all is called now but for itself: "/car/left/motor/radius" of
/// /robot/left/motor/parameter/radius, if /robot/left has the section /car/left. "": there is no section, or it stands
/// for other parameters.
[[nodiscard]] std::string EntryInSection(const FrameworkElement& parameter, const std::string& name);

}  // namespace runnel
