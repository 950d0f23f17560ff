#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/base/result.h"
#include "plugins/structure/change_text.h"

namespace runnel {

/// All of the changes or none. Plugins that their types need are loaded. A module that takes the place of
/// another one has to prove itself before the answer comes (3 s at the latest).
struct ChangeRequest {
  /// Changes in one set at most.
  static constexpr std::size_t kMostChanges = 20'000;

  PlacedChanges placed;
  std::string label = {};   ///< for the history; "": the changes in their text format
  std::string client = {};  ///< who wants it, for people: "a terminal", "viewer 2"
  /// Whether the whole application may be deleted, which ends its run and cannot be undone.
  bool may_end_application = false;
};
/// Takes back what was changed last.
struct UndoRequest {};
/// Does again what was taken back last.
struct RedoRequest {};
struct SaveRequest {
  std::string file = {};  ///< "": the one that the application came from
  /// Whether the file must be one that SavePlace() allows: for clients that are not this user's own.
  bool is_confined = false;
  std::string application_file = {};  ///< for SavePlace(): that the application came from
  /// Values of parameters into the configuration instead; "": into the files that it was loaded with.
  bool is_configuration = false;
  /// Whether `file` may take the place of another application's.
  bool overwrites = false;
};
/// Loads a plugin as it is now on disk, and makes its modules anew.
struct ReloadRequest {
  std::string plugin;
};
/// Sets the value at a port by hand: readers find it instead of what is published, until a ReleaseRequest.
struct PublishRequest {
  static constexpr double kSlowestRate = 0.001;
  static constexpr double kFastestRate = 1000;
  static constexpr Duration kShortestDeadline = std::chrono::milliseconds(10);
  static constexpr Duration kLongestDeadline = std::chrono::minutes(1);
  static constexpr std::size_t kLongestLease = 100;

  std::string port;
  std::string value = {};  ///< text format
  /// Publishes it again so often, in seconds of the application's clock; without, once.
  std::optional<double> rate = {};
  /// By the machine's clock: if nothing new has come by then, readers find the safe value until it is released
  /// (HandSettings).
  std::optional<Duration> deadline = {};
  /// Who drives gives each hold another name: see HandLeases. "": none.
  std::string lease = {};
  /// By the machine's clock, from which the deadline counts; CommandService::Begin() says so.
  std::optional<Time> received = {};
};
/// Readers of the port find its safe value until a ReleaseRequest, and nobody may set another one (Port::Block()).
struct BlockRequest {
  std::string port;
};
/// Readers of the port find again what is published: ends its block, and its value by hand.
struct ReleaseRequest {
  std::string port;
};
/// Presses or releases the STOP of the robot (RobotStop). CommandService::Begin() does it at once, in the caller's
/// thread: neither the worker nor the structure lock is waited for.
struct RobotStopRequest {
  bool is_pressed = true;
  std::string by = {};  ///< who wants it, for people: "a terminal", "viewer 2"
};

/// Leaves modules, or what a thread runs, out of cycles, with what the application does then; or no more.
struct PauseRequest {
  std::string path;
  bool is_paused = true;
};

/// Makes a module anew by its own type, as after a fault; of a group, all that have failed. Without a
/// path, the whole application is built anew from its file and run again, with the same settings, also when its run has
/// ended and is held.
struct RestartRequest {
  std::string path = {};
};
/// Ends the run in order, as Ctrl-C does, also one that has ended and is held.
struct QuitRequest {};

/// What a client may ask a CommandService for.
using CommandRequest =
    std::variant<ChangeRequest, UndoRequest, RedoRequest, SaveRequest, ReloadRequest, PauseRequest, PublishRequest,
                 BlockRequest, ReleaseRequest, RobotStopRequest, RestartRequest, QuitRequest>;

/// What has come of a request.
struct CommandAnswer {
  enum class Outcome {
    kDone,
    kFailed,   ///< it could have worked, and has not
    kRefused,  ///< what was asked for cannot be done; nothing has been
  };
  Outcome outcome = Outcome::kDone;
  std::string text;         ///< what was done, for people: "done; threads stood still for 0.110 ms"
  Diagnostics diagnostics;  ///< errors if it was not done; warnings of what was
  std::string client = {};  ///< of what was undone or redone: who had wanted it
  /// What has to be said besides for it to be done: "overwrite", "yes"; "": that would not help.
  std::string needs = {};
  bool stops_nothing = false;  ///< the STOP is in force, and nothing is marked as driving
  bool leaves_some = false;    ///< the STOP is in force, and does not reach all that drives

  explicit operator bool() const noexcept { return outcome == Outcome::kDone; }

  [[nodiscard]] static CommandAnswer Done(std::string text) {
    return {.outcome = Outcome::kDone, .text = std::move(text), .diagnostics = {}, .needs = {}};
  }
  [[nodiscard]] static CommandAnswer Failed(Error error, Outcome outcome = Outcome::kFailed) {
    CommandAnswer answer{.outcome = outcome, .text = {}, .diagnostics = {}, .needs = {}};
    answer.diagnostics.Add(std::move(error));
    return answer;
  }
  [[nodiscard]] static CommandAnswer Refused(Error error) { return Failed(std::move(error), Outcome::kRefused); }
  /// Not done until somebody says that it is meant.
  [[nodiscard]] static CommandAnswer Asks(Error error, std::string needs) {
    CommandAnswer answer = Refused(std::move(error));
    answer.needs = std::move(needs);
    return answer;
  }
};

}  // namespace runnel
