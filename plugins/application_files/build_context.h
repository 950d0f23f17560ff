#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/element/runtime.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/port.h"
#include "plugins/application_files/part_files.h"
#include "plugins/application_files/xml_tag.h"
#include "plugins/parameters/configuration.h"

namespace runnel {

/// What builds applications: the runtime they go into, and where the parts come from.
///
/// Ownership: of nothing; all must outlive the build.
struct BuildTools {
  Runtime& runtime;
  PluginManager& plugins;
  XmlTagRegistry& tags;
  Configuration& configuration;
};

/// What is done once all tags have been handled, in this order. Within a stage the order is that of
/// the file.
enum class BuildStage {
  kParameters,    ///< parameters are set
  kConstruction,  ///< modules make the ports that follow from them
  kInterfaces,    ///< interface ports, which may take their type from modules; the inner groups' come
                  ///< before the outer ones', those of one group in the order of the file
  kConnections,   ///< ports are connected, threads assigned
  kChecks,        ///< what can be said of the whole only
};

/// One build, as those who handle tags see it: where errors go, what is put off, and what is known
/// to be missing so that one mistake is told once.
///
/// Threads: used by the building thread, under the structure lock.
class BuildContext {
 public:
  /// Plugins that are loaded may add tags.
  BuildContext(const BuildTools& tools, std::filesystem::path folder, Diagnostics& diagnostics)
      : tools_(tools), parts_(std::move(folder)), diagnostics_(diagnostics) {
    plugins().registry().Offer(tags());
  }

  [[nodiscard]] Runtime& runtime() const noexcept { return tools_.runtime; }
  [[nodiscard]] PluginManager& plugins() const noexcept { return tools_.plugins; }
  [[nodiscard]] XmlTagRegistry& tags() const noexcept { return tools_.tags; }
  [[nodiscard]] Configuration& configuration() const noexcept { return tools_.configuration; }
  /// Where relative file names start that stand at `place`.
  [[nodiscard]] std::filesystem::path FolderOf(const SourcePosition& place) const {
    return parts_.FolderOf(place.file);
  }

  /// The files that describe the inside of groups.
  [[nodiscard]] PartFiles& parts() noexcept { return parts_; }
  /// Whether `value` may stand in the attribute. The error says what may; without a message, that a
  /// plugin which could not be loaded may have brought it.
  [[nodiscard]] Result<void> CheckValue(const AttributeRule& rule, std::string_view value) const;

  /// Any error makes the build fail, after all of the file has been looked at. The place in the
  /// file and the path are put in where the error has none itself.
  void Report(Error error, const SourcePosition& position, const FrameworkElement& element);
  void Warn(Error warning, const SourcePosition& position, const FrameworkElement& element);
  [[nodiscard]] bool ok() const noexcept { return diagnostics_.ok(); }

  /// On whose behalf something is done: what errors say of where it went wrong.
  struct Cause {
    std::string what;
    SourcePosition position;
    const FrameworkElement* element = nullptr;
  };
  /// Does it; an exception becomes an error of `cause`.
  void Attempt(const Cause& cause, const std::function<void()>& action);

  /// Puts off what needs the rest of the file, with the cause of the attempt in which it is called.
  /// An action may defer to later stages.
  void Defer(BuildStage stage, std::function<void()> action);
  void RunDeferred();

  /// A tag directly in `parent` made nothing, or what it made goes by another name, and an error says
  /// so: whoever refers to it need not complain again. `name`: of the tag, nullptr if it has none.
  void MarkMissing(const FrameworkElement& parent, const XmlAttribute* name);
  /// The element has not got what is said of it, and an error says so: nothing that is missing in it is news.
  void MarkUnbuilt(const FrameworkElement& element) {
    unbuilt_.insert(&element);
    MarkUnfed(element);
  }
  /// Whether all that the file says of the inside of the element has been made.
  [[nodiscard]] bool IsWhole(const FrameworkElement& element) const;
  /// Whether to complain that there is no `name` in `parent`, which has `candidates`.
  [[nodiscard]] bool IsNews(const FrameworkElement& parent, std::string_view name,
                            const std::vector<std::string>& candidates) const;
  /// A connection to something in `element`, or to itself, failed with an error.
  void MarkUnfed(const FrameworkElement& element) { unfed_.insert(&element); }
  /// Whether it is news that nothing is connected to the input.
  [[nodiscard]] bool IsUnfedUnnoticed(const Port& input) const;

  /// True the first time: a fault of an element that shows in many places is told once.
  [[nodiscard]] bool IsFirstFaultOf(const FrameworkElement& element) { return faulty_.insert(&element).second; }

  /// The command line has set the parameter, which beats all else.
  void NoteCommandLine(const FrameworkElement& parameter) { from_command_line_.insert(&parameter); }
  [[nodiscard]] bool IsFromCommandLine(const FrameworkElement& parameter) const {
    return from_command_line_.contains(&parameter);
  }

  /// A plugin could not be loaded: what is unknown may come with it.
  void MarkPluginMissing() noexcept { plugin_is_missing_ = true; }
  /// Whether to complain about an unknown name of a kind that plugins bring.
  [[nodiscard]] bool IsWorthReporting(std::string_view unknown, const std::vector<std::string>& known) const;

 private:
  struct Deferred {
    Cause cause;
    std::function<void()> action;
  };

  const BuildTools tools_;
  // The error with its place, path and where a part is used; false if it has been told of another
  // use of the same part.
  bool Place(Error& error, const SourcePosition& position, const FrameworkElement& element);

  PartFiles parts_;
  std::set<std::string> told_;  // of what stands in parts
  Diagnostics& diagnostics_;
  std::map<BuildStage, std::vector<Deferred>> deferred_;
  Cause cause_;
  std::set<std::pair<const FrameworkElement*, std::string>> missing_;
  std::set<const FrameworkElement*> incomplete_;  // in which something is missing, whatever its name
  std::set<const FrameworkElement*> unbuilt_;
  std::set<const FrameworkElement*> unfed_;
  std::set<const FrameworkElement*> faulty_;
  std::set<const FrameworkElement*> from_command_line_;
  bool plugin_is_missing_ = false;
};

}  // namespace runnel
