#pragma once

#include <filesystem>

#include "core/base/diagnostics.h"
#include "core/xml/xml_document.h"
#include "plugins/runtime_construction/build_context.h"

namespace runnel {

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
[[nodiscard]] BuildOutcome BuildApplication(const std::filesystem::path& file,
                                            const BuildTools& tools, BuildMode mode);

/// The same for a document that has been read already. Relative file names in it start in `folder`.
[[nodiscard]] BuildOutcome BuildApplication(const XmlDocument& document,
                                            const std::filesystem::path& folder,
                                            const BuildTools& tools, BuildMode mode);

}  // namespace runnel
