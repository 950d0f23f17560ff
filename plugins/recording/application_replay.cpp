#include "plugins/recording/application_replay.h"

#include <utility>

#include "core/types/duration_text.h"
#include "plugins/application/application.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recorded_ports.h"
#include "plugins/recording/recording_info.h"

namespace runnel {

namespace {

// Real threads publish the last values in their next cycle.
constexpr Duration kLastCycle = std::chrono::seconds(1);

}  // namespace

std::optional<BuildOutcome> ApplicationReplay::Build(const ApplicationFile* file,
                                                     const BuildTools& tools) {
  if (file != nullptr) return std::nullopt;
  return BuildRecordedPorts(file_, tools);
}

Result<void> ApplicationReplay::Prepare(FrameworkElement& /*application*/,
                                        SchedulerOptions& options) {
  is_simulated_ = options.clock == SchedulerOptions::ClockKind::kSimulated;
  if (is_simulated_) options.speed = 1;
  return {};
}

Result<void> ApplicationReplay::Begin(Application& application, Diagnostics& diagnostics) {
  const auto warn = [&](std::string message) {
    diagnostics.AddWarning({.message = std::move(message), .position = {file_}});
  };
  runtime_ = &application.runtime();
  scheduler_ = &application.scheduler();
  auto reader = McapReader::Open(file_);
  if (!reader) return reader.error();
  const auto& contents = (*reader)->contents();
  if (contents.damage) {
    warn("played is what comes before its damage: " + contents.damage->message);
  }
  was_simulated_ = AboutText(**reader, "clock") == "simulated";
  auto player = Player::Prepare(*runtime_, std::move(*reader), options_);
  if (!player) return player.error();
  player_ = std::move(*player);
  std::string missing;
  for (const std::string& path : player_->missing()) missing += " " + path;
  if (!missing.empty()) warn("not played, for the application does not have:" + missing);
  return {};
}

// Simulated time goes on where the recording was, so that values bear the times that they bore.
void ApplicationReplay::OnStart() {
  if (is_simulated_ && was_simulated_) scheduler_->simulated_clock().Set(player_->start());
  player_->Start(runtime_->clock().Now());
}

std::optional<Duration> ApplicationReplay::limit() const {
  if (options_.loops) return {};
  // Simulated cycles that are due at the very end have not run when it is reached.
  return player_->length() + (is_simulated_ ? Duration(1) : kLastCycle);
}

std::optional<bool> ApplicationReplay::IsOver() {
  return player_->failure() || (!is_simulated_ && player_->is_over());
}

std::string ApplicationReplay::Finish(Diagnostics& problems) {
  if (const auto failure = player_->failure()) problems.Add(*failure);
  const std::size_t ports = player_->ports();
  return "replayed " + DurationText(player_->length()) +
         (options_.loops ? ", again and again: " : ": ") + std::to_string(player_->published()) +
         " values at " + std::to_string(ports) + (ports == 1 ? " port" : " ports") +
         (player_->calls() > 0 ? ", " + std::to_string(player_->calls()) + " calls\n" : "\n");
}

}  // namespace runnel
