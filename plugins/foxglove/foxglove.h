#pragma once

#include <functional>
#include <string>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "plugins/structure/change.h"
#include "plugins/web_server/web_conversation.h"

namespace runnel {

/// What Foxglove and its like are shown. What is referred to must outlive the server.
struct FoxgloveApplication {
  Runtime& runtime;
  std::string name;
  std::string version = {};  ///< of the program
  /// Clients look, and change nothing.
  bool is_read_only = false;
  /// Carries out a client's change, and tells who is to know. Called by a thread of the protocol's own,
  /// and may wait. Without it parameters cannot be set.
  std::function<Result<void>(const ChangeSet& changes)> change = {};
};

/// The Foxglove WebSocket protocol: the ports, parameters and connections of an application for Foxglove,
/// Lichtblick, PlotJuggler and whatever else speaks it. See README.md for topics and limits.
///
/// Threads:  conversations on the server's; changes on one of the protocol's own, which ends with the
///           server. Neither ever takes part in a cycle.
[[nodiscard]] WebProtocol FoxgloveProtocol(FoxgloveApplication application);

}  // namespace runnel
