#include "apps/runnel/replay.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include "core/base/diagnostics.h"
#include "core/types/duration_text.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recording_info.h"

namespace runnel::program {

namespace {

// Real threads publish the last values in their next cycle.
constexpr Duration kLastCycle = std::chrono::seconds(1);

std::optional<Duration> Seconds(const std::optional<double>& seconds) {
  if (!seconds) return {};
  return FromSeconds(*seconds);
}

void Warn(std::string message, const std::string& file) {
  Diagnostics diagnostics;
  diagnostics.AddWarning({.message = std::move(message), .position = {.file = file}});
  std::cerr << diagnostics.ToString();
}

}  // namespace

Result<std::unique_ptr<Replay>> Replay::Prepare(const ReplayArguments& arguments, Runtime& runtime,
                                                Scheduler& scheduler) {
  auto reader = McapReader::Open(arguments.file);
  if (!reader) return reader.error();
  const auto& contents = (*reader)->contents();
  if (contents.damage) {
    Warn("played is what comes before its damage: " + contents.damage->message, arguments.file);
  }
  std::unique_ptr<Replay> replay(new Replay(arguments, runtime, scheduler));
  replay->was_simulated_ = AboutText(**reader, "clock") == "simulated";
  auto player = Player::Prepare(runtime, std::move(*reader),
                                {.ports = arguments.ports,
                                 .from = Seconds(arguments.from),
                                 .to = Seconds(arguments.to),
                                 .loops = arguments.loops});
  if (!player) return player.error();
  replay->player_ = std::move(*player);
  std::string missing;
  for (const std::string& path : replay->player_->missing()) missing += " " + path;
  if (!missing.empty())
    Warn("not played, for the application does not have:" + missing, arguments.file);
  return replay;
}

bool Replay::is_simulated() const {
  return scheduler_.options().clock == SchedulerOptions::ClockKind::kSimulated;
}

// Simulated time goes on where the recording was, so that values bear the times that they bore.
void Replay::Start() {
  if (is_simulated() && was_simulated_) scheduler_.simulated_clock().Set(player_->start());
  player_->Start(runtime_.clock().Now());
}

std::optional<Duration> Replay::limit() const {
  if (arguments_.loops) return {};
  // Simulated cycles that are due at the very end have not run when it is reached.
  return player_->length() + (is_simulated() ? Duration(1) : kLastCycle);
}

bool Replay::LookAround() {
  if (arguments_.steps) StepWhenAsked();
  if (player_->failure()) return true;
  return !is_simulated() && player_->is_over();
}

void Replay::StepWhenAsked() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (input_has_ended_ || poll(&input, 1, 0) <= 0) return;
  std::array<char, 256> typed;
  const ssize_t count = read(STDIN_FILENO, typed.data(), typed.size());
  input_has_ended_ = count <= 0;
  if (count <= 0) return;
  const auto lines = std::count(typed.data(), typed.data() + count, '\n');
  if (lines > 0) (void)scheduler_.pace().StepCycles(static_cast<std::uint64_t>(lines));
}

std::string Replay::Text() const {
  const std::size_t ports = player_->ports();
  return "replayed " + DurationText(player_->length()) +
         (arguments_.loops ? ", again and again: " : ": ") + std::to_string(player_->published()) +
         " values at " + std::to_string(ports) + (ports == 1 ? " port\n" : " ports\n");
}

}  // namespace runnel::program
