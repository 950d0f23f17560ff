#pragma once

#include <string>

#include "core/base/clock.h"
#include "plugins/command_service/command_service.h"
#include "plugins/web_server/web_session.h"

namespace runnel {

/// What Foxglove and its like are shown. What is referred to must outlive the server.
struct FoxgloveApplication {
  CommandService& service;
  std::string name;
  std::string version = {};  ///< of the program
  /// Clients look, and change nothing.
  bool is_read_only = false;
  /// What something moves by has its safe value if its client publishes nothing for so long. Foxglove's panel for driving
  /// publishes once a second, and ceases when its button is let go.
  Duration drive_deadline = std::chrono::milliseconds(1500);
  /// By which sessions know when to look again; nullptr: the machine's. Outlives the server.
  const Clock* steady_clock = nullptr;
};

/// The Foxglove WebSocket protocol: the ports, parameters and connections of an application for Foxglove,
/// Lichtblick, PlotJuggler and whatever else speaks it. See README.md for topics and limits.
///
/// Threads:  sessions on the server's, changes on the service's worker. Neither ever takes part in a cycle.
[[nodiscard]] WebProtocol FoxgloveProtocol(FoxgloveApplication application);

}  // namespace runnel
