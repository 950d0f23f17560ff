#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/recording/recording_player.h"

namespace runnel {

/// Plays a recording into an application instead of what its modules publish.
///
///     auto application = Application::Load("robot.xml",
///         {.extensions_by_name = {{"recording", {{{"recording", "run.mcap"}, {"ports", "laser/scan"}}}}}});
///     application->Run();   // until all has been played
///
/// Without an application file, ports are made for all that is recorded.
/// Simulated time passes as real time does unless the options say otherwise, and goes on where the recording was.
/// Errors: of loading: see McapReader::Open(), Player::Prepare(). What cannot be played is a warning.
class ApplicationReplay final : public ApplicationExtension {
 public:
  explicit ApplicationReplay(std::string file, PlayerOptions options = {})
      : file_(std::move(file)), options_(std::move(options)) {}

  std::optional<BuildOutcome> Build(const ApplicationFile* file, const BuildTools& tools) override;
  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override;
  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  void OnStart() override;
  [[nodiscard]] std::optional<Duration> limit() const override;
  std::optional<bool> IsOver() override;
  [[nodiscard]] bool Replays() const override { return true; }
  std::string Finish(Diagnostics& problems) override;
  void End() noexcept override { player_.reset(); }

 private:
  const std::string file_;
  const PlayerOptions options_;
  Runtime* runtime_ = nullptr;
  Scheduler* scheduler_ = nullptr;
  std::unique_ptr<Player> player_;
  bool is_simulated_ = false;
  bool was_simulated_ = false;  // when it was recorded
};

/// Makes ports for all that a recording has, with the paths that were recorded, so that it can be replayed
/// without the application that it is of: `echo`, viewers and recorders find them. Types come from the
/// plugins that can be found; what is of none of them is left out, with a warning. As BuildApplication() with
/// kConstruct.
///
/// Errors: no recording; none of its types is known.
[[nodiscard]] BuildOutcome BuildRecordedPorts(const std::string& file, const BuildTools& tools);

}  // namespace runnel
