#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "plugins/network/network_options.h"

namespace runnel {

/// What nodes of ROS 2 are told of this application besides its topics: that it is a node, its clock, its log.
///
/// Threads: Start(), Tell(), SendClock() and destroying by one; the log by a thread of its own.
class RosNode {
 public:
  /// Errors: of the engine.
  static Result<std::unique_ptr<RosNode>> Start(const RosOptions& options, WireParticipant& participant,
                                                Runtime& runtime, bool is_simulated);

  /// Which topics the node reads and writes, if that has changed.
  void Tell(std::vector<WireId> readers, std::vector<WireId> writers);
  /// The time, if it has changed; when it wants to be called again, by the steady clock; nothing: never.
  std::optional<Time> SendClock(Time now);

 private:
  RosNode(const RosOptions& options, const WireId& participant, const Clock& clock)
      : options_(options), participant_(participant), clock_(clock) {}
  void Say(const LogMessage& message, bool is_simulated);

  const RosOptions options_;
  const WireId participant_;
  const Clock& clock_;
  std::vector<WireId> readers_;
  std::vector<WireId> writers_;
  bool has_told_ = false;
  std::unique_ptr<WireWriter> entities_;
  std::unique_ptr<WireWriter> time_;
  std::unique_ptr<WireWriter> log_;
  Time last_time_{Duration(-1)};
  std::unique_ptr<LogSink> sink_;
};

}  // namespace runnel
