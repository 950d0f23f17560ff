#include "apps/runnel/outside_access.h"

#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "apps/runnel/recording.h"
#include "apps/runnel/remote_recording.h"
#include "core/base/diagnostics.h"
#include "plugins/application_files/application_saver.h"
#include "plugins/foxglove/foxglove.h"
#include "plugins/inspector/inspector_resources.h"
#include "plugins/inspector/xml_inspector_tag.h"
#include "plugins/runtime_construction/plugin_loading.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/reload.h"

namespace runnel::program {

namespace {

void Warn(Error warning) {
  Diagnostics diagnostics;
  diagnostics.AddWarning(std::move(warning));
  std::cerr << diagnostics.ToString();
}

ControlHooks HooksOf(const RunArguments& arguments, Workplace& workplace,
                     const FrameworkElement& application, Scheduler& scheduler,
                     StructureEditor& editor) {
  ControlHooks hooks;
  hooks.load_plugin = [&workplace](const std::string& plugin) {
    return LoadPlugin(plugin, workplace.plugins(), workplace.tags());
  };
  hooks.save = [&workplace,
                path = application.path()](const std::string& file) -> Result<std::string> {
    const std::lock_guard lock(workplace.runtime().structure_mutex());
    const auto found = workplace.runtime().root().Find(path);  // it may have been deleted
    if (!found) return found.error();
    const SaveTools tools{workplace.plugins(), workplace.tags()};
    const auto saved =
        file.empty() ? SaveApplication(**found, tools) : SaveApplication(**found, tools, file);
    if (!saved) return saved.error();
    return "saved " + path + (file.empty() ? "" : " to " + file);
  };
  hooks.reload = [&workplace, &editor](const std::string& plugin) -> Result<std::string> {
    workplace.tags().set_plugin(plugin);
    const auto outcome = ReloadPlugin(workplace.plugins(), editor, workplace.runtime(), plugin);
    if (!outcome) return outcome.diagnostics.errors().front();
    return "loaded " + plugin + " anew";
  };
  hooks.record = RecordingHookOf(AboutApplication(arguments.application, application.name()),
                                 workplace.runtime(), scheduler);
  return hooks;
}

// Where the inspector shall be; nothing if none is wanted. Errors: the place is none.
struct Wish {
  InspectorPlace place;
  bool is_exact = false;  // no other port will do
};
Result<std::optional<Wish>> WishOf(const InspectArguments& arguments,
                                   const FrameworkElement& application) {
  const auto in_file = InspectorPlaceOf(application);
  if (arguments.is_refused || (!in_file && !arguments.is_wanted())) return std::optional<Wish>();
  Wish wish{in_file.value_or(InspectorPlace{})};
  if (!arguments.place.empty() && arguments.place != InspectArguments::kUsualPlace) {
    const auto place = ParseInspectorPlace(arguments.place);
    if (!place) return place.error();
    wish.place.address = place->address;
    wish.place.port = place->port;
    wish.is_exact = true;
  }
  if (!arguments.token.empty()) wish.place.token = arguments.token;
  wish.place.is_read_only = wish.place.is_read_only || arguments.is_read_only;
  return std::optional(wish);
}

Result<std::unique_ptr<WebServer>> StartWebServer(const Wish& wish,
                                                  const std::vector<std::string>& origins,
                                                  const std::vector<WebProtocol>& protocols) {
  const auto resources = InspectorResources();
  WebServerOptions options{.address = wish.place.address,
                           .port = wish.place.port,
                           .token = wish.place.token,
                           .origins = origins};
  auto server = WebServer::Start(options, resources, protocols);
  if (server || wish.is_exact || options.port == 0) return server;
  Error notice = server.error();
  options.port = 0;
  server = WebServer::Start(options, resources, protocols);
  if (!server) return server;
  notice.hint = "the inspector takes " + std::to_string((*server)->port());
  Warn(notice);
  return server;
}

FoxgloveApplication FoxgloveOf(const ControlledApplication& controlled, const std::string& name,
                               bool is_read_only) {
  return {.runtime = controlled.runtime,
          .name = name,
          .version = RUNNEL_VERSION,
          .is_read_only = is_read_only,
          .change = [&history = *controlled.history,
                     &log = controlled.log](const ChangeSet& changes) -> Result<void> {
            const ChangeOutcome outcome = history.Apply(changes);
            std::string text = outcome ? "" : "refused: ";
            for (const Change& change : changes) text += ChangeText(change) + "; ";
            log.Add(ControlLog::Kind::kChange, text.substr(0, text.size() - 2));
            if (outcome) return {};
            return outcome.diagnostics.errors().front();
          }};
}

}  // namespace

Result<std::unique_ptr<OutsideAccess>> OutsideAccess::Start(
    const RunArguments& arguments, Workplace& workplace, FrameworkElement& application,
    Scheduler& scheduler, StructureEditor& editor, ChangeHistory& history, ControlLog& log) {
  std::unique_ptr<OutsideAccess> access(new OutsideAccess);
  const ControlledApplication controlled{
      workplace.runtime(),
      workplace.plugins().modules(),
      editor,
      log,
      HooksOf(arguments, workplace, application, scheduler, editor),
      &history,
      &scheduler.pace()};
  const std::string& built_from = arguments.application.file;
  const std::string file = built_from.empty() ? "" : std::filesystem::absolute(built_from).string();
  if (arguments.has_control) {
    auto control =
        ControlServer::Start(controlled, {.application = application.name(), .file = file});
    if (control) {
      access->control_ = std::move(*control);
    } else {
      Error warning = control.error();
      warning.message = "other processes cannot reach this application: " + warning.message;
      Warn(std::move(warning));
    }
  }
  const auto wish = WishOf(arguments.inspect, application);
  if (!wish) return wish.error();
  if (!*wish) return access;
  access->inspector_ =
      std::make_unique<Inspector>(controlled, scheduler,
                                  InspectorOptions{.application = application.name(),
                                                   .file = file,
                                                   .version = RUNNEL_VERSION,
                                                   .is_read_only = (*wish)->place.is_read_only});
  auto web = StartWebServer(
      **wish, arguments.inspect.origins,
      {access->inspector_->Protocol(),
       FoxgloveProtocol(FoxgloveOf(controlled, application.name(), (*wish)->place.is_read_only))});
  if (!web) {
    Error error = web.error();
    error.message = "the inspector cannot be started: " + error.message;
    return error;
  }
  access->web_ = std::move(*web);
  std::cout << "inspector: " << access->web_->url() << '\n' << std::flush;
  return access;
}

void OutsideAccess::Hear(const Fault& fault) {
  if (inspector_ != nullptr) inspector_->Hear(fault);
}

void OutsideAccess::NoteEnd(const std::string& verdict) {
  if (inspector_ != nullptr) inspector_->NoteEnd(verdict);
}

}  // namespace runnel::program
