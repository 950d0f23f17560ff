#include <algorithm>
#include <thread>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/saving.h"

namespace runnel::internal {

namespace {

// Its file names ports that are not there when it is built alone.
bool IsConnectedWithOthers(FrameworkElement& application) {
  const auto is_outside = [&](const Port* port) { return !port->IsAtOrBelow(application); };
  bool is_connected = false;
  application.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || is_connected) return;
    const auto leads_out = [&](const Connection& each) { return is_outside(each.to); };
    is_connected = std::ranges::any_of(port->incoming(), is_outside) ||
                   std::ranges::any_of(port->outgoing(), leads_out);
  });
  return is_connected;
}

Error WouldNotLoad(Error reason) {
  reason.message = "the file would not load, and is left as it was: " + reason.message;
  return reason;
}

}  // namespace

Result<void> CheckSavedText(FrameworkElement& application, std::string_view text,
                            const std::filesystem::path& file, const SaveTools& tools) {
  const auto document = XmlDocument::Parse(text, file.string());
  if (!document) return WouldNotLoad(document.error());
  if (IsConnectedWithOthers(application)) return {};
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
