#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/element/runtime.h"
#include "plugins/command_service/command_request.h"
#include "plugins/command_service/command_worker.h"

namespace runnel {

/// Sets the value at a port by hand, from its text format (Port::PublishByHand()); fields that the text leaves
/// out have their usual values. Which port it was. Locks. Errors: no such port, with the nearest; no value of
/// its type; a type without a text format.
Result<std::string> SetPortByHand(Runtime& runtime, const std::string& path,
                                  const std::string& value);
/// Gives it back to its publishers; "" : all that are set. Which these were. Errors: no such port; nothing is
/// set by hand there.
Result<std::string> ReleasePort(Runtime& runtime, const std::string& path);

/// What people set at the ports of an application, once or again and again.
///
/// Threads: the worker's.
class HandSettings {
 public:
  HandSettings(Runtime& runtime, CommandWorker& worker) : runtime_(runtime), tasks_(worker) {}

  Result<std::string> Publish(const PublishRequest& request);
  Result<std::string> Release(const ReleaseRequest& request);

 private:
  Runtime& runtime_;
  // Which publishing at a port is the last one: those before end.
  std::map<std::string, std::uint64_t, std::less<>> last_;
  std::uint64_t count_ = 0;
  TaskGroup tasks_;  // first to go: its tasks use the rest
};

}  // namespace runnel
