#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/diagnostics.h"
#include "plugins/structure/change_text.h"

namespace runnel {

/// All of the changes or none. Plugins that their types need are loaded. A module that takes the place of
/// another one has to prove itself before the answer comes (3 s at the latest).
struct ChangeRequest {
  /// Changes in one set at most.
  static constexpr std::size_t kMostChanges = 20'000;

  PlacedChanges placed;
  std::string label = {};  ///< for the history; "": the changes in their text format
  std::string client = {};  ///< who wants it, for people: "a terminal", "viewer 2"
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
};
/// Loads a plugin as it is now on disk, and makes its modules anew.
struct ReloadRequest {
  std::string plugin;
};
/// From which level on modules at and below a path are logged.
struct LogLevelRequest {
  std::string path = {};  ///< "" or "/": all
  std::string level;      ///< as LogLevelName() says it, or "inherit": as above it
};
/// Sets the value at a port by hand: readers find it instead of what is published, until a ReleaseRequest.
struct PublishRequest {
  static constexpr double kFastestRate = 1000;

  std::string port;
  std::string value;  ///< text format
  /// Publishes it again so often, in seconds of the application's clock; without, once.
  std::optional<double> rate = {};
};
/// Readers of the port find again what is published.
struct ReleaseRequest {
  std::string port = {};  ///< "": all that are set by hand
};

/// Leaves modules, or what a thread runs, out of cycles, with what the application does then; or no more.
struct PauseRequest {
  std::string path;
  bool is_paused = true;
};

/// What a client may ask a CommandService for.
using CommandRequest = std::variant<ChangeRequest, UndoRequest, RedoRequest, SaveRequest,
                                    ReloadRequest, LogLevelRequest, PauseRequest, PublishRequest,
                                    ReleaseRequest>;

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

  explicit operator bool() const noexcept { return outcome == Outcome::kDone; }

  [[nodiscard]] static CommandAnswer Done(std::string text) {
    return {.outcome = Outcome::kDone, .text = std::move(text), .diagnostics = {}};
  }
  [[nodiscard]] static CommandAnswer Failed(Error error, Outcome outcome = Outcome::kFailed) {
    CommandAnswer answer{.outcome = outcome, .text = {}, .diagnostics = {}};
    answer.diagnostics.Add(std::move(error));
    return answer;
  }
  [[nodiscard]] static CommandAnswer Refused(Error error) {
    return Failed(std::move(error), Outcome::kRefused);
  }
};

}  // namespace runnel
