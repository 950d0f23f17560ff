#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/clock.h"
#include "core/base/error.h"
#include "plugins/structure/change.h"

namespace runnel {

/// A value that readers of a port find instead of what is published (value_by_hand.h).
struct SafeValue {
  std::string port;                       ///< path
  std::optional<std::string> value = {};  ///< in its text format; without one, the port's default
};

/// What an application does about something: values that readers find instead of what is published, changes of its
/// structure, as one change set, and perhaps the end of the run.
struct Reaction {
  std::vector<SafeValue> published = {};
  std::list<std::string> released = {};  ///< paths of ports whose readers find again what is published
  ChangeSet changes = {};
  bool ends_run = false;
  std::string description = {};  ///< in the past: "switched /a/in from /b/out to /c/out"

  [[nodiscard]] bool is_empty() const noexcept {
    return published.empty() && released.empty() && changes.empty() && !ends_run;
  }
  /// `move` is called with each path, and with the description.
  void MovePaths(const std::function<void(std::string& path)>& move) {
    for (SafeValue& each : published) move(each.port);
    for (std::string& each : released) move(each);
    for (Change& each : changes) {  // those that reactions are made of
      const auto move_ends = [&](auto& tie) { move(tie.from), move(tie.to); };
      if (auto* const cut = std::get_if<DisconnectPorts>(&each)) move_ends(*cut);
      if (auto* const tie = std::get_if<ConnectPorts>(&each)) move_ends(*tie);
      if (auto* const set = std::get_if<SetParameter>(&each)) move(set->path);
      if (auto* const replace = std::get_if<ReplaceModule>(&each)) move(replace->path);
    }
    move(description);
  }
  /// Has this one, which is done when all is well again, release what the first one publishes.
  void TakeBack(const Reaction& first) {
    for (const SafeValue& each : first.published) released.push_back(each.port);
  }
};

/// What is watched, and what is done about it.
struct SupervisionRule {
  enum class When {
    kStale,  ///< an input brings nothing new. Watched are the outputs that feed it when the rule is added, so that the
             ///< rule can switch it to others and still sees the first ones come back; of an output, that output itself
    kFault,  ///< a module has thrown, and so has failed
    kStuck,  ///< a module does not return from its cycle; it goes on when it returns
    kPaused,  ///< somebody has paused modules (Supervisor::SetPaused()): done once they stand still
  };
  When when = When::kStale;
  std::string of;    ///< path of the port, or of the element with all below it; of what is paused, or is run by it
  Duration after{};  ///< stale: nothing new has come for longer; stuck: by the machine's clock, one run takes longer
  Duration fresh_after{};  ///< fresh again when values have come that long without such a gap
  Reaction reaction = {};
  Reaction otherwise = {};  ///< when all is well again; never after a fault
  SourcePosition position = {};
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
  bool is_failure = false;   ///< the reaction could not be carried out
  bool is_recovery = false;  ///< what was wrong is so no more
};

}  // namespace runnel
