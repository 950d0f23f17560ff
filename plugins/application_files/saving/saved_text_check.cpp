#include <thread>

#include "core/element/runtime.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

namespace {

Error WouldNotLoad(Error reason) {
  reason.message = "the file would not load, and is left as it was: " + reason.message;
  return reason;
}

}  // namespace

Result<void> CheckSavedText(FrameworkElement& application, std::string_view text,
                            const std::filesystem::path& file, const SaveTools& tools) {
  const auto document = XmlDocument::Parse(text, file.string());
  if (!document) return WouldNotLoad(document.error());
  // Its file names ports that are not there when it is built alone.
  if (!ExternalConnectionsOf(application).empty()) return {};
  Diagnostics diagnostics;
  // In a thread of its own, for this one holds the lock of another tree.
  std::thread([&] {
    Runtime runtime;
    Configuration none;
    diagnostics = BuildApplication(*document, file.parent_path(),
                                   {runtime, tools.plugins, tools.tags, none}, BuildMode::kCheck)
                      .diagnostics;
  }).join();
  if (!diagnostics.ok()) return WouldNotLoad(diagnostics.errors().front());
  return {};
}

}  // namespace runnel::internal
