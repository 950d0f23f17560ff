#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/plugin/plugin_manager.h"
#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// Where the words and the module types of files come from: those that built the application.
struct SaveTools {
  PluginManager& plugins;
  XmlTagRegistry& tags;
};

/// Writes a text that gives what the application is now to `file` ("": the one that it came from), at once or not at
/// all (core/base/files.h), after building it once in a runtime of its own as `runnel check` does: a text that would not
/// load never replaces a file. If the application came from a file, it is that text with what has changed since, and
/// all else byte for byte as it was; if it was built by code, a new one. Values that came from the command line or a
/// configuration are left to these, unless they have been changed since; one that an output sets comes anew by the
/// connection, and is left as it was.
///
/// An application that came from no file is from now on that of `file`; one that came from another remains that
/// file's, and `file` is a copy. What is replaced is kept as FILE~. One that is connected with another application cannot be built alone; then only
/// what can be known of the text itself is checked.
///
/// Threads: any outside of cycles, without the structure lock, which it takes; but not while it builds.
/// Errors: a module of no registered type; a change of what another file describes; a required input
///         that nothing is connected to; that the text would not load; the file it came from is not what was
///         loaded: somebody has changed it meanwhile.
///
/// What the file has lost, for people: tags that name something that is gone; "": nothing.
/// `runtime`: of the application, which others may delete meanwhile.
[[nodiscard]] Result<std::string> SaveApplication(Runtime& runtime, FrameworkElement& application,
                                                  const SaveTools& tools, const std::filesystem::path& file = {});

}  // namespace runnel
