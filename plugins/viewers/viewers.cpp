// Shows an application to browsers (the inspector) and to whatever speaks Foxglove's protocol, if options or file
// (`<inspector>`) ask for it.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/plugin_entry.h"
#include "plugins/application/application.h"
#include "plugins/foxglove/foxglove.h"
#include "plugins/inspector/inspector.h"
#include "plugins/inspector/inspector_place.h"
#include "plugins/inspector/page/inspector_page.h"
#include "plugins/inspector/xml_inspector_tag.h"
#include "plugins/web_server/access_rules.h"
#include "plugins/web_server/web_server.h"

namespace runnel {

namespace {

struct ViewerOptions {
  bool is_wanted = false;   // also if the application file does not say so
  bool is_refused = false;  // whatever the file says
  bool is_held = false;     // after the run, until Ctrl-C
  // "[ADDRESS:]PORT"; "": what the file says, or else port 8765 of this machine, or any that is free.
  std::string place = {};
  std::string token = {};                 // "": the file's, or see WebServerOptions
  std::vector<std::string> origins = {};  // of pages of other places that may connect
  bool is_read_only = false;
};

struct ViewerRequest {
  InspectorPlace place;
  bool is_exact = false;  // no other port will do
};

// Where the viewers shall be; nothing if none are wanted. Errors: the place is none.
Result<std::optional<ViewerRequest>> RequestOf(const ViewerOptions& options,
                                               const FrameworkElement& application) {
  const auto in_file = InspectorPlaceOf(application);
  if (options.is_refused || (!in_file && !options.is_wanted)) return std::optional<ViewerRequest>();
  ViewerRequest request{in_file.value_or(InspectorPlace{})};
  if (!options.place.empty()) {
    const auto place = ParseInspectorPlace(options.place);
    if (!place) return place.error();
    request.place.address = place->address;
    request.place.port = place->port;
    request.is_exact = true;
  }
  if (!options.token.empty()) request.place.token = options.token;
  request.place.is_read_only = request.place.is_read_only || options.is_read_only;
  return std::optional(request);
}

Result<std::unique_ptr<WebServer>> StartServer(const ViewerRequest& request,
                                               const std::vector<std::string>& origins,
                                               const std::vector<WebProtocol>& protocols,
                                               Diagnostics& diagnostics) {
  const auto& resources = InspectorPage();
  WebServerOptions options{.address = request.place.address,
                           .port = request.place.port,
                           .token = request.place.token,
                           .origins = origins};
  auto server = WebServer::Start(options, resources, protocols);
  if (server || request.is_exact || options.port == 0) return server;
  Error notice = server.error();
  options.port = 0;
  server = WebServer::Start(options, resources, protocols);
  if (!server) return server;
  notice.hint = "the inspector takes " + std::to_string((*server)->port());
  diagnostics.AddWarning(notice);
  return server;
}

class Viewers final : public ApplicationExtension {
 public:
  explicit Viewers(ViewerOptions options) : options_(std::move(options)) {}

  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  std::string StartText() const override {
    return web_ != nullptr ? "inspector: " + web_->url() + "\n" : "";
  }
  void OnEnd(const std::string& verdict) override {
    if (inspector_ != nullptr) inspector_->NoteEnd(verdict);
  }
  bool IsHeld() const override { return options_.is_held; }
  void End() noexcept override {
    web_.reset();
    inspector_.reset();
  }

 private:
  const ViewerOptions options_;
  std::unique_ptr<Inspector> inspector_;
  std::unique_ptr<WebServer> web_;  // uses the inspector
};

Result<void> Viewers::Begin(Application& application, Diagnostics& diagnostics) {
  const auto request = RequestOf(options_, application.element());
  if (!request) return request.error();
  if (!*request) return {};
  const bool is_read_only = (*request)->place.is_read_only;
  inspector_ = std::make_unique<Inspector>(application.service(), application.scheduler(),
                                           InspectorOptions{.application = application.name(),
                                                            .file = application.file(),
                                                            .version = Application::Version(),
                                                            .is_read_only = is_read_only});
  auto web =
      StartServer(**request, options_.origins,
                  {inspector_->Protocol(), FoxgloveProtocol({.service = application.service(),
                                                             .name = application.name(),
                                                             .version = Application::Version(),
                                                             .is_read_only = is_read_only})},
                  diagnostics);
  if (!web) {
    Error error = web.error();
    error.message = "the inspector cannot be started: " + error.message;
    return error;
  }
  web_ = std::move(*web);
  return {};
}

Result<Extensions> MakeViewers(const ExtensionArguments& arguments) {
  ViewerOptions options{.is_wanted = !arguments.values.empty(),
                        .is_refused = arguments.Has("no-inspect"),
                        .is_held = arguments.Has("hold"),
                        .place = arguments.Find("inspect"),
                        .token = arguments.Find("inspect-token"),
                        .origins = arguments.All("inspect-origin"),
                        .is_read_only = arguments.Has("inspect-read-only")};
  if (options.is_held && options.is_refused) {
    return Error{.message = "--hold is for viewers, and --no-inspect refuses them"};
  }
  if (!options.place.empty()) {
    if (const auto place = ParseInspectorPlace(options.place); !place) return place.error();
  }
  if (arguments.Has("inspect-token")) {
    if (const auto good = CheckToken(options.token); !good) return good.error();
  }
  return Extensions{std::make_shared<Viewers>(std::move(options))};
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(viewers, registry) {
  if (auto* const tags = registry.Find<runnel::XmlTagRegistry>()) runnel::AddInspectorTag(*tags);
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeViewers);
  }
}
