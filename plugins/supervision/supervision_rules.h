#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "plugins/structure/change.h"

namespace runnel {

/// A value that readers of a port find instead of what is published (value_by_hand.h).
struct SafeValue {
  std::string port;                        ///< path
  std::optional<std::string> value = {};  ///< in its text format; without one, the port's default
};

/// What an application does about something: values that readers find instead of what is published, changes of its
/// structure, as one change set, and perhaps the end of the run.
struct Reaction {
  std::vector<SafeValue> published = {};
  std::vector<std::string> released = {};  ///< paths of ports whose readers find again what is published
  ChangeSet changes = {};
  bool stops_application = false;
  std::string description = {};  ///< in the past: "switched /a/in from /b/out to /c/out"

  [[nodiscard]] bool is_empty() const noexcept {
    return published.empty() && released.empty() && changes.empty() && !stops_application;
  }
  /// Has this one, which is done when all is well again, release what the first one publishes.
  void TakeBack(const Reaction& first) {
    for (const SafeValue& each : first.published) released.push_back(each.port);
  }
};

/// An input that brings nothing new for a while. Watched are the outputs that feed it when the rule is
/// added, so that the rule can switch it to others and still sees the first ones come back.
struct StaleRule {
  std::string input;       ///< path of the port; of an output, that output itself is watched
  Duration after{};        ///< stale when nothing new has come for longer; > 0
  Duration fresh_after{};  ///< fresh again when values have come that long without such a gap
  Reaction on_stale;
  Reaction on_fresh = {};
};

/// A module that has thrown and has been stopped.
struct FaultReaction {
  std::string of;  ///< path: faults of this element and of all below it
  Reaction reaction;
};

/// A module that does not return from its cycle. It goes on when it returns.
struct StuckReaction {
  std::string of;    ///< path: this element and all below it
  Duration after{};  ///< stuck when one run of a task takes longer, on the machine's clock; > 0
  Reaction on_stuck = {};
  Reaction on_return = {};
};

/// Modules that somebody has paused (Supervisor::SetPaused()): safe values, once they stand still.
struct PauseReaction {
  std::string of;  ///< path; done when what is paused is at or above it, or its thread is
  Reaction on_pause = {};
  Reaction on_resume = {};
};

/// A port by which somebody presses the STOP of the robot: each value but 0 and false does.
struct StopButtonRule {
  std::string port;       ///< path: what sends there is a number or a truth value
  bool releases = false;  ///< letting go, a 0 after another value, releases it
};

/// Something that has been done by a rule, or could not be.
struct Notice {
  std::string path;  ///< of what the rule watches
  std::string message;
  Time time{};
  bool is_failure = false;  ///< the reaction could not be carried out
  bool is_recovery = false;  ///< what was wrong is so no more
};

}  // namespace runnel
