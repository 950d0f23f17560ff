#include "plugins/application_files/saving/application_saver.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/files.h"
#include "core/base/retry.h"
#include "core/element/runtime.h"
#include "core/paths/late_connections.h"
#include "core/port/proxy_port.h"
#include "core/xml/xml_editor.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/parameters/configuration_saver.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/renamed_text.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;
using internal::Saving;

std::string WholeText(Saving& saving) {
  NewElement root =
      internal::ElementOf(*saving.tools.tags.FindTag("application"),
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
  const auto feeds = [&](const Port* source) { return !is_new_file || source->IsAtOrBelow(saving.application); };
  saving.application.VisitAll<const Port>([&](const Port& port) {
    if (!port.is_required()) return;
    const std::vector<Port*> sources = port.Sources();
    if (std::ranges::any_of(sources, feeds) || LateConnections::Awaits(port)) return;
    if (std::ranges::count(saving.edges, &port, &internal::SavedEdge::to) > 0) return;  // a rule has cut it
    const std::string what =
        sources.empty() ? "nothing is connected to this input" : "only another application feeds this input";
    saving.Fail({.message = what + ", which its module requires: a file that says so would not load",
                 .path = port.path(),
                 .hint = "connect it, or delete the module"});
  });
}

// To another application: stop buttons and recorders have their ports beside the tree.
bool IsTiedToOthers(FrameworkElement& application) {
  const FrameworkElement& root = application.runtime().root();
  const auto is_there = [&](const Port& port) {
    const auto found = root.Find(port.path());
    return found && *found == &port;
  };
  return std::ranges::any_of(internal::ExternalConnectionsOf(application),
                             [&](const Connection& tie) { return is_there(*tie.from) && is_there(*tie.to); });
}

Error WouldNotLoad(const Error& reason) { return reason.WithContext("the file would not load, and is left as it was"); }

// Whether `text`, which is to stand in `file` for the application, would load. It is built without the structure lock, which
// others need meanwhile. `is_alone`: its file names no ports that are not there when it is built alone.
Result<void> CheckSavedText(std::string_view text, const fs::path& file, const SaveTools& tools, bool is_alone) {
  const auto document = XmlDocument::Parse(text, file.string());
  if (!document) return WouldNotLoad(document.error());
  if (!is_alone) return {};
  Runtime runtime;
  Configuration none;
  const Diagnostics diagnostics =
      BuildApplication(*document, file.parent_path(), {runtime, tools.plugins, tools.tags, none}, BuildMode::kCheck)
          .diagnostics;
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

Result<internal::SavedText> internal::TextOfApplication(FrameworkElement& application, const SaveTools& tools,
                                                        const fs::path& folder) {
  Saving saving{application, tools, folder, internal::EdgesOf(application)};
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  CheckRequiredInputs(saving, source == nullptr);
  RefuseInterface(saving);
  Result<std::string> text = source != nullptr ? UpdatedText(saving, *source) : Result<std::string>(WholeText(saving));
  if (!text) return text.error();
  if (saving.error) return *saving.error;
  return internal::SavedText{std::move(*text), std::move(saving.values), std::move(saving.lost)};
}

Result<std::string> SaveApplication(Runtime& runtime, FrameworkElement& application, const SaveTools& tools,
                                    const fs::path& to) {
  constexpr int kAttempts = 20;
  std::optional<internal::SavedText> checked;
  std::uint64_t revision = 0;  // at which it was
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::unique_lock lock(runtime.structure_mutex());
    if (std::ranges::find(runtime.root().children(), &application) == runtime.root().children().end()) {
      return Error{.message = "the application has been deleted meanwhile"};
    }
    auto* source = application.FindAnnotation<ApplicationSource>();
    if (to.empty() && source == nullptr) {
      return Error{.message = "the application was built by code, and has no file yet",
                   .path = application.path(),
                   .hint = "name one"};
    }
    const fs::path file = to.empty() ? source->file : to;
    if (to.empty() && fs::absolute(file).string().find("/share/runnel/xml/") != std::string::npos) {
      return Error{.message = "the file comes with Runnel, and its next version would take what is saved there away",
                   .position = {file.string()},
                   .hint = "name a file of your own"};
    }
    const bool is_its_own = source == nullptr || Whole(source->file) == Whole(file);
    if (source != nullptr && is_its_own) {
      if (auto unchanged = CheckUnchanged(*source); !unchanged) return unchanged.error();
    }
    // What modules set by their outputs may be another value each time.
    const bool is_checked = checked && revision == runtime.revision();
    auto saved =
        is_checked ? Result(std::move(*checked)) : internal::TextOfApplication(application, tools, file.parent_path());
    if (!saved) return saved.error();
    const bool is_on_disk = source != nullptr && is_its_own && saved->text == source->text && fs::exists(source->file);
    if (!is_on_disk && !is_checked) {
      const bool is_alone = !IsTiedToOthers(application);
      revision = runtime.revision();
      lock.unlock();
      if (auto good = CheckSavedText(saved->text, file, tools, is_alone); !good) return good.error();
      checked = std::move(*saved);
      continue;  // unless others have changed the application meanwhile, it is written
    }
    // All that needs memory comes before the file is another one.
    const auto now =
        source != nullptr ? std::make_unique<ApplicationSource>(*source) : std::make_unique<ApplicationSource>();
    now->file = file;
    now->text = saved->text;
    if (!is_on_disk) {
      if (auto kept = KeepBackup(file); !kept) return kept.error();
      if (auto written = ReplaceFile(file, saved->text); !written) return written.error();
    }
    if (!is_its_own) return std::move(saved->lost);
    ForgetNewNames(application);
    for (const auto& each : saved->values) {
      Retry([&] { each.first->Annotate(std::make_unique<LoadedValue>(each.second)); });
    }
    if (source != nullptr) {
      *source = std::move(*now);
    } else {
      Retry([&] { application.Annotate(std::make_unique<ApplicationSource>(*now)); });
    }
    return std::move(saved->lost);
  }
  return Error{
      .message = "others change the application all the time; gave up after " + std::to_string(kAttempts) + " attempts",
      .hint = "save again when they have ended"};
}

}  // namespace runnel
