#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/port/port.h"
#include "plugins/foxglove/internal/foxglove_shared.h"

namespace runnel::internal {

/// The channel on which a client publishes into an input: an output beside the application, connected to
/// the input for as long as this lives.
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
  /// Errors: the JSON is none of the type; the input cannot be had (any more).
  Result<void> Publish(std::string_view json);
  /// What has come of making the output, once; nothing if that is not known yet, or all is well.
  [[nodiscard]] std::optional<Error> TakeError();
  /// Whether values can be published (which some may still not be good for).
  [[nodiscard]] bool is_made() const noexcept { return is_made_; }
  /// Publishes what has waited. Whether it is still to be called.
  bool Continue();

 private:
  class Place;           // the output's, in the tree
  struct PendingOutput;  // with the worker

  static Result<void> Make(FoxgloveShared& shared, const DirectoryInput& input,
                           PendingOutput& pending);
  Result<void> PublishWaiting();

  FoxgloveShared& shared_;
  const TypeInfo& type_;
  const std::shared_ptr<PendingOutput> pending_;
  std::shared_ptr<WorkerTask> task_;  // until it is done
  bool is_made_ = false;
  std::optional<std::string> waiting_;
  RobotStop::AsOf as_of_;  // of what waits
  std::optional<Error> error_;
  std::string usual_;  // the value that T{} has, as JSON
};

}  // namespace runnel::internal
