#pragma once

#include <memory>
#include <string>

#include "plugins/application/application_extension.h"
#include "plugins/recording/recording_player.h"

namespace runnel {

/// Plays a recording into an application instead of what its modules publish.
///
///     auto replay = std::make_shared<ApplicationReplay>("run.mcap", PlayerOptions{.ports = {"laser/scan"}});
///     auto application = Application::Load("robot.xml", {.extensions = {replay}});
///     application->Run();   // until all has been played
///
/// Simulated time passes as real time does unless the options say otherwise, and goes on where the recording was.
/// Errors: of loading: see McapReader::Open(), Player::Prepare(). What cannot be played is a warning.
class ApplicationReplay final : public ApplicationExtension {
 public:
  explicit ApplicationReplay(std::string file, PlayerOptions options = {})
      : file_(std::move(file)), options_(std::move(options)) {}

  /// What ended it early.
  [[nodiscard]] std::optional<Error> failure() const { return player_->failure(); }
  /// "replayed 12.3 s: 240 values at 2 ports", with an end of line.
  [[nodiscard]] std::string Text() const;

  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override;
  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  void OnStart() override;
  [[nodiscard]] std::optional<Duration> limit() const override;
  std::optional<bool> IsOver() override;
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

}  // namespace runnel
