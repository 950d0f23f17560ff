#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plugins/foxglove/internal/directory.h"

namespace runnel::internal {

struct FoxgloveShared;

/// The STOP of the robot, for whoever may look: a service, and a topic that clients read and publish to.
inline constexpr std::string_view kStopName = "/stop";
/// A service that ends it, for who may drive.
inline constexpr std::string_view kReleaseName = "/release";

[[nodiscard]] std::vector<DirectoryService> StopServices();
/// Whether it is in force, and since when by whom; its values are RobotStop::States.
[[nodiscard]] FoxgloveChannel StopChannel();

/// Presses, unless the JSON says {"data": false}, which does nothing; `name`: kReleaseName releases. What has been
/// done, as JSON for the reply. At once, in the calling thread.
[[nodiscard]] std::string SetStop(FoxgloveShared& shared, std::string_view name, std::string_view json);

}  // namespace runnel::internal
