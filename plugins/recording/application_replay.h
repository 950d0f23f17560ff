#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/recording/recording_player.h"

namespace runnel {

/// Plays a recording into an application instead of what its modules publish.
///
///     auto application = Application::Load("robot.xml",
///         {.extensions_by_name = {{"recording", {{{"recording", "run.mcap"}, {"ports", "laser/scan"}}}}}});
///     application->Run();   // until all has been played
///
/// Without an application file, ports are made for all that is recorded, with the paths that were recorded, so that it can
/// be replayed without the application that it is of: `echo`, viewers and recorders find them. Types come from the plugins
/// that can be found; what is of none of them is left out, with a warning.
/// Simulated time passes as real time does unless the options say otherwise, and goes on where the recording was.
/// Errors: of loading: see McapReader::Open(), Player::Prepare(); without a file, that none of its types is known. What
/// cannot be played is a warning.
[[nodiscard]] std::shared_ptr<ApplicationExtension> MakeReplay(std::string file, PlayerOptions options);

}  // namespace runnel
