#include "plugins/inspector/inspector.h"

#include <utility>

#include "plugins/inspector/internal/inspection.h"
#include "plugins/inspector/internal/viewer_session.h"

namespace runnel {

Inspector::Inspector(CommandService& service, Scheduler& scheduler, InspectorOptions options)
    : shared_(std::make_unique<internal::Inspection>(service, scheduler, std::move(options))) {}
Inspector::~Inspector() = default;

WebProtocol Inspector::Protocol() {
  return {.names = {"runnel.inspector.v1", internal::ViewerSession::kStopProtocol},
          .start = [shared = shared_.get()](WebClient& client) -> std::unique_ptr<WebSession> {
            return std::make_unique<internal::ViewerSession>(*shared, client);
          },
          .kept_name = internal::ViewerSession::kStopProtocol};
}

void Inspector::NoteEnd(std::string verdict) { shared_->NoteEnd(std::move(verdict)); }

}  // namespace runnel
