#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/xml/xml_document.h"
#include "plugins/application_files/build_context.h"

namespace runnel {

/// Kept with an application that came from a file: what the file said, so that it can be saved again
/// with what has changed, and with nothing else.
struct ApplicationSource final : Annotation {
  std::filesystem::path file;
  std::string text;  ///< of the file, byte for byte
  /// Of the files that describe the inside of its groups, by the names that errors have for them.
  std::map<std::string, std::string> parts;
};

enum class BuildMode {
  kRun,        ///< the application is there and ready afterwards
  kConstruct,  ///< the application is there, but nothing is made ready: to look at it
  kCheck,      ///< all is checked that can be without making anything ready; nothing is left
};

/// What came of building an application.
struct BuildOutcome {
  FrameworkElement* application = nullptr;  ///< nullptr if there were errors, or in kCheck
  Diagnostics diagnostics = {};
};

/// Builds what an application file describes below one new group of the runtime's root, and makes
/// it ready. All or nothing: with one error or more, the tree is afterwards what it was before.
/// Plugins that were loaded stay loaded.
///
/// Threads:  any that is not in a cycle; holds the structure lock while it builds, so that nobody
///           sees half an application.
/// Errors:   all of the file at once, with place, path and cure.
[[nodiscard]] BuildOutcome BuildApplication(const std::filesystem::path& file, const BuildTools& tools, BuildMode mode);

[[nodiscard]] BuildOutcome BuildApplication(const ApplicationFile& file, const BuildTools& tools, BuildMode mode);

/// The same for a document that has been read already. Relative file names in it start in `folder`.
[[nodiscard]] BuildOutcome BuildApplication(const XmlDocument& document, const std::filesystem::path& folder,
                                            const BuildTools& tools, BuildMode mode);

/// Makes an application ready that was built with kConstruct, as kRun does at once: a program that
/// runs it makes its scheduler in between, from what the file says.
///
/// Threads: as BuildApplication(). Errors: what an element says that could not be prepared, with its
/// place in the file; nothing is ready then.
[[nodiscard]] Result<void> MakeApplicationReady(FrameworkElement& application);

/// The same of one element of it, and of all below.
[[nodiscard]] Result<void> MakeReady(FrameworkElement& application, FrameworkElement& element);

/// For builders: what is left to be done in `mode` with an application that has been read. Not under
/// the structure lock.
void FinishBuild(BuildOutcome& outcome, BuildMode mode);

/// Reports each input at or below `application` that has to be connected and is not, unless a
/// connection meant for it failed and that was reported.
void CheckRequiredInputs(FrameworkElement& application, BuildContext& context);

/// Goes through an application file once, from top to bottom: checks every tag against what the
/// registry knows, and has those that are right handled. Of a tag that is wrong the first mistake is
/// told; it is not handled, and what is in it is checked only.
///
/// What the root tag has made; nullptr if it could not. Errors: all go to the context.
[[nodiscard]] FrameworkElement* ReadApplication(XmlElement root, BuildContext& context);

/// Makes in `group` what the file says that `tag` names as its type. Errors: it cannot be read.
[[nodiscard]] Result<void> ReadGroupType(const XmlAttribute& type, XmlElement tag, FrameworkElement& group,
                                         BuildContext& context);

}  // namespace runnel
