#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/runnel/command_line.h"
#include "core/base/result.h"
#include "core/element/runtime.h"
#include "plugins/recording/recording_player.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::program {

/// A recording that is played into an application while that runs.
class Replay {
 public:
  /// Says on stderr what cannot be played. Errors: see McapReader::Open(), Player::Prepare().
  static Result<std::unique_ptr<Replay>> Prepare(const ReplayArguments& arguments, Runtime& runtime,
                                                 Scheduler& scheduler);

  /// Just before the first cycle.
  void Start();
  /// How long the application is to run at most; nullopt: until it is stopped.
  [[nodiscard]] std::optional<Duration> limit() const;
  /// Between cycles; true: there is nothing more to play.
  bool LookAround();
  /// What ended it early.
  [[nodiscard]] std::optional<Error> failure() const { return player_->failure(); }
  /// "replayed 12.3 s: 240 values at 2 ports".
  [[nodiscard]] std::string Text() const;

 private:
  Replay(const ReplayArguments& arguments, Runtime& runtime, Scheduler& scheduler)
      : arguments_(arguments), runtime_(runtime), scheduler_(scheduler) {}
  [[nodiscard]] bool is_simulated() const;
  void StepWhenAsked();

  const ReplayArguments arguments_;
  Runtime& runtime_;
  Scheduler& scheduler_;
  std::unique_ptr<Player> player_;
  bool was_simulated_ = false;  // when it was recorded
  bool input_has_ended_ = false;
};

}  // namespace runnel::program
