#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/port/port.h"
#include "plugins/foxglove/internal/foxglove_shared.h"

namespace runnel::internal {

/// The channel on which a client publishes into an input: an output beside the application, connected to
/// the input for as long as this lives. Where something moves by it, the client drives it by hand instead, with a deadline:
/// the safe value is there at once when this goes, and after a while if the client falls silent (HandSettings).
///
/// Threads:    the server's; making and removing the output are left to the worker, which may wait.
/// Ownership:  what is shared outlives it, and sees to what it has left to do.
class ClientPublication {
 public:
  /// `wake` has the session take a turn, from any thread.
  ClientPublication(FoxgloveShared& shared, const DirectoryInput& input,
                    std::function<void()> wake);
  ~ClientPublication();
  ClientPublication(const ClientPublication&) = delete;
  ClientPublication& operator=(const ClientPublication&) = delete;

  /// Publishes a value that is told in JSON as its channel would tell it; fields that are left out have
  /// their usual values. One that comes before the output is there, or while the structure is locked,
  /// waits, and only the last one does.
  /// `received`: by the machine's clock. Errors: the JSON is none of the type; the input cannot be had (any more).
  Result<void> Publish(std::string_view json, Time received);
  [[nodiscard]] const DirectoryInput& input() const noexcept { return input_; }
  /// What has come of making the output, once; nothing if that is not known yet, or all is well.
  [[nodiscard]] std::optional<Error> TakeError();
  /// Whether values can be published (which some may still not be good for).
  [[nodiscard]] bool is_made() const noexcept { return is_made_; }
  /// Publishes what has waited. Whether it is still to be called.
  bool Continue();

 private:
  class Place;  // the output's, in the tree

  static Result<void> Make(FoxgloveShared& shared, const DirectoryInput& input, const std::string& name);
  Result<void> Drive(std::string_view json, Time received);
  Result<void> PublishWaiting();
  // Of what the client leaves out, the type's own value.
  Result<void> Read(std::string_view json, void* value) const;

  FoxgloveShared& shared_;
  const DirectoryInput input_;
  const TypeInfo& type_;
  const std::function<void()> wake_;
  const std::string place_;           // its name, below the root
  std::shared_ptr<WorkerTask> task_;  // until it is done
  bool is_made_ = false;
  std::optional<std::string> waiting_;
  RobotStop::AsOf as_of_;  // of what waits
  std::optional<Error> error_;
  // Of what drives: one hold, for as long as values come in time, and the newest of them while it is carried out.
  std::string lease_;
  Time heard_{};
  std::unique_ptr<PendingCommand> driving_;
  std::string usual_;  // the value that T{} has, as JSON
};

}  // namespace runnel::internal
