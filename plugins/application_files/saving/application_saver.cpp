#include "plugins/application_files/saving/application_saver.h"

#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

#include "core/base/replace_file.h"
#include "core/base/retry.h"
#include "core/element/runtime.h"
#include "core/paths/late_connections.h"
#include "core/port/proxy_port.h"
#include "core/xml/xml_editor.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/renamed_text.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;
using internal::Saving;

std::string WholeText(Saving& saving) {
  NewElement root = internal::ElementOf(
      *saving.tools.tags.FindTag("application"),
      {{{"name", saving.application.name()}}, &saving.application}, saving.application, saving);
  std::vector<NewElement> loads;
  for (const std::string& plugin : saving.plugins) {
    loads.push_back({.name = "load", .attributes = {{"plugin", plugin}}});
  }
  if (!loads.empty() && !root.children.empty()) root.children.front().after_blank_line = true;
  root.children.insert(root.children.begin(), loads.begin(), loads.end());
  return ElementText(root);
}

Result<std::string> UpdatedText(Saving& saving, const ApplicationSource& loaded) {
  ApplicationSource source = loaded;
  const NewNames names = NewNamesIn(saving.application);
  auto renamed = RenamedText(loaded.text, loaded.file, names, PathAttributesIn(saving.tools.tags));
  if (!renamed) return renamed.error();
  source.text = std::move(*renamed);
  for (const auto& [path, value] : std::exchange(source.values, {})) source.values.emplace(RenamedPath(path, "", names), value);
  const auto document = XmlDocument::Parse(source.text, source.file.string());
  if (!document) return document.error();
  XmlEditor editor(*document, source.text);
  internal::FileUpdate(saving, source, editor).Run(document->root());
  return editor.Finish();
}

void RefuseInterface(Saving& saving) {
  for (const FrameworkElement* child : saving.application.children()) {
    if (dynamic_cast<const ProxyPort*>(child) == nullptr) continue;
    saving.Fail({.message = "a file cannot give an application an interface",
                 .path = child->path(),
                 .hint = "put it into a group"});
  }
}

// A file that would not load is no use; better to be told now. A new file has no connections from
// other applications.
void CheckRequiredInputs(Saving& saving, bool is_new_file) {
  const auto feeds = [&](const Port* source) {
    return !is_new_file || source->IsAtOrBelow(saving.application);
  };
  saving.application.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || !port->is_required()) return;
    const std::vector<Port*> sources = port->Sources();
    if (std::ranges::any_of(sources, feeds) || LateConnections::Awaits(*port)) return;
    const std::string what = sources.empty() ? "nothing is connected to this input"
                                             : "only another application feeds this input";
    saving.Fail(
        {.message = what + ", which its module requires: a file that says so would not load",
         .path = port->path(),
         .hint = "connect it, or delete the module"});
  });
}

Error WouldNotLoad(Error reason) {
  reason.message = "the file would not load, and is left as it was: " + reason.message;
  return reason;
}

// Whether `text`, which is to stand in `file` for the application, would load.
Result<void> CheckSavedText(FrameworkElement& application, std::string_view text,
                            const fs::path& file, const SaveTools& tools) {
  const auto document = XmlDocument::Parse(text, file.string());
  if (!document) return WouldNotLoad(document.error());
  // Its file names ports that are not there when it is built alone.
  if (!internal::ExternalConnectionsOf(application).empty()) return {};
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

// Whoever has changed the file meanwhile would lose what they did. A file that is gone may come
// back.
Result<void> CheckUnchanged(const ApplicationSource& source) {
  std::error_code ignored;
  if (!fs::exists(source.file, ignored)) return {};
  const auto now = XmlDocument::ReadText(source.file);
  if (!now) return now.error();
  if (*now == source.text) return {};
  return Error{.message = "the file has been changed since the application was loaded from it",
               .position = {source.file.string()},
               .hint = "save to another file, and compare the two"};
}

}  // namespace

Result<internal::SavedText> internal::TextOfApplication(FrameworkElement& application,
                                                        const SaveTools& tools,
                                                        const fs::path& folder) {
  Saving saving{application, tools, folder, internal::EdgesOf(application)};
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  CheckRequiredInputs(saving, source == nullptr);
  RefuseInterface(saving);
  Result<std::string> text =
      source != nullptr ? UpdatedText(saving, *source) : Result<std::string>(WholeText(saving));
  if (!text) return text.error();
  if (saving.error) return *saving.error;
  return internal::SavedText{std::move(*text), std::move(saving.values)};
}

Result<void> SaveApplication(FrameworkElement& application, const SaveTools& tools,
                             const fs::path& to) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  auto* source = application.FindAnnotation<ApplicationSource>();
  if (to.empty() && source == nullptr) {
    return Error{.message = "the application was built by code, and has no file yet",
                 .path = application.path(),
                 .hint = "name one"};
  }
  const fs::path file = to.empty() ? source->file : to;
  const bool is_its_own =
      source == nullptr || Whole(source->file) == Whole(file);
  if (source != nullptr && is_its_own) {
    if (auto unchanged = CheckUnchanged(*source); !unchanged) return unchanged;
  }
  auto saved = internal::TextOfApplication(application, tools, file.parent_path());
  if (!saved) return saved.error();
  const bool is_on_disk =
      source != nullptr && is_its_own && saved->text == source->text && fs::exists(source->file);
  // All that needs memory comes before the file is another one.
  const auto now = source != nullptr ? std::make_unique<ApplicationSource>(*source)
                                     : std::make_unique<ApplicationSource>();
  now->file = file;
  now->text = saved->text;
  now->values = std::move(saved->values);
  if (!is_on_disk) {
    auto good = CheckSavedText(application, saved->text, file, tools);
    if (!good) return good;
    if (auto kept = KeepBackup(file); !kept) return kept;
    if (auto written = ReplaceFile(file, saved->text); !written) return written;
  }
  if (!is_its_own) return {};
  ForgetNewNames(application);
  if (source != nullptr) {
    *source = std::move(*now);
  } else {
    Retry([&] { application.Annotate(std::make_unique<ApplicationSource>(*now)); });
  }
  return {};
}

}  // namespace runnel
