#include "plugins/viewers/viewers.h"

#include <optional>
#include <utility>

#include "plugins/application/application.h"
#include "plugins/foxglove/foxglove.h"
#include "plugins/inspector/inspector_place.h"
#include "plugins/inspector/inspector_resources.h"
#include "plugins/inspector/xml_inspector_tag.h"

namespace runnel {

namespace {

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
  const auto resources = InspectorResources();
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

}  // namespace

void Viewers::AddWords(XmlTagRegistry& tags) { AddInspectorTag(tags); }

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

void Viewers::OnEnd(const std::string& verdict) {
  if (inspector_ != nullptr) inspector_->NoteEnd(verdict);
}

void Viewers::End() noexcept {
  web_.reset();
  inspector_.reset();
}

}  // namespace runnel
