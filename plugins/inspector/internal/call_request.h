#pragma once

#include "plugins/inspector/internal/requests.h"

namespace runnel::internal {

/// How values of one port could be passed on to another: parts and conversions. Waits for the structure lock.
[[nodiscard]] std::string FindConversions(Inspection& inspection, const ViewerMessage& message);

/// Calls a service for a viewer: the reply's text is what the service replies. Given up when the viewer goes.
[[nodiscard]] ViewerRequest BeginCallRequest(Inspection& inspection, ViewerMessage message, std::function<void()> on_done);

/// Asks what is under way at a service to end. Waits for the structure lock.
[[nodiscard]] std::string AbortCall(Inspection& inspection, const ViewerMessage& message);

}  // namespace runnel::internal
