#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "plugins/ros_messages/node_messages.h"
#include "plugins/ros_services/parameter_services.h"
#include "plugins/ros_services/ros_time.h"
#include "plugins/ros_services/stop_service.h"
#include "plugins/wire/wire.h"

namespace runnel {

class Logger;

/// How an application is, told on /diagnostics once a second of its time, and at once when it has got better or worse.
///
/// Threads: one at a time.
class DiagnosticsTopic {
 public:
  /// Called several times a second, while somebody listens. Not under the structure lock.
  using Health = std::function<std::vector<RosDiagnosticStatus>()>;

  /// `clock`: the application's. Errors: of the engine.
  static Result<std::unique_ptr<DiagnosticsTopic>> Start(WireParticipant& participant, const Clock& clock,
                                                         ClockOffset offset, Health health,
                                                         std::function<void()> on_news);

  /// Tells what is due. When it wants to be called again, by the steady clock; nothing: when there are news.
  std::optional<Time> Send(Time now);
  [[nodiscard]] const WireId& id() const noexcept { return writer_->id(); }

 private:
  DiagnosticsTopic(const Clock& clock, ClockOffset offset, Health health)
      : clock_(clock), offset_(std::move(offset)), health_(std::move(health)) {}

  const Clock& clock_;
  const ClockOffset offset_;
  const Health health_;
  std::shared_ptr<std::atomic<std::size_t>> listeners_ = std::make_shared<std::atomic<std::size_t>>(0);
  std::vector<RosHealth> told_;
  std::optional<Time> told_at_;  // of the application
  std::unique_ptr<WireWriter> writer_;
};

/// The names that ROS_DISTRO may have, by their age.
[[nodiscard]] const std::vector<std::string>& RosDistributions();

/// What nodes of ROS 2 may do with parameters. In the order of RosParameterUses().
enum class RosParameterUse { kNone, kRead, kWrite };
/// none, read, write.
[[nodiscard]] const std::vector<std::string>& RosParameterUses();

/// What nodes of ROS 2 are told besides.
struct RosOptions {
  std::string distribution = {};   ///< of RosDistributions(): "" if the application is to be no node
  std::string node = {};           ///< "/base"
  bool sends_clock = false;        ///< on /clock
  bool follows_clock = false;      ///< the application's time is that of /clock
  bool sends_log = false;          ///< on /rosout
  bool sends_diagnostics = false;  ///< on /diagnostics
  RosParameterUse parameters = RosParameterUse::kNone;
  bool stop_releases = false;  ///< the service ~/stop releases the STOP, too
};

/// What an application does for nodes of ROS 2. All optional.
struct RosHooks {
  ServiceDialect dialect = ServiceDialect::kInFront;  ///< of the engine
  const DiscoveryTable* table = nullptr;              ///< of who is there
  ParameterSetter set_parameters = {};
  DiagnosticsTopic::Health health = {};
  /// What /clock shows. By threads of the engine.
  std::function<Result<void>(Time)> set_time = {};
  std::function<Duration()> clock_lead = {};  ///< ClockOffset::lead
  /// As ServiceHooks::is_stop_kept.
  std::function<bool()> is_stop_kept = {};
  /// What a STOP that is in force leaves, as an error.
  std::function<Result<void>()> check_stop = {};
};

/// What nodes of ROS 2 are told of this application besides its topics: that it is a node, its clock, its log, its parameters,
/// its health. They stop the robot by it.
///
/// Threads: Start(), Tell(), Work() and destroying by one; the log and the parameters by threads of their own.
class RosNode {
 public:
  /// `on_news` has Work() called. What the engine does not do, for want of a permission for one, is told by the log, and left
  /// out.
  static std::unique_ptr<RosNode> Start(const RosOptions& options, WireParticipant& participant,
                                        FrameworkElement& application, bool is_simulated, Logger& log, RosHooks hooks,
                                        std::function<void()> on_news);

  /// Which topics the node reads and writes, if that has changed.
  void Tell(std::vector<WireId> readers, std::vector<WireId> writers);
  /// Tells what is due; when it wants to be called again, by the steady clock; nothing: never.
  std::optional<Time> Work(Time now);

 private:
  RosNode(const RosOptions& options, const WireId& participant, const Clock& clock, ClockOffset offset)
      : options_(options), participant_(participant), clock_(clock), offset_(std::move(offset)) {}
  void MakeTopics(WireParticipant& participant, Runtime& runtime, const std::function<void(const Error&)>& tell);
  Result<void> FollowClock(WireParticipant& participant, const std::function<Result<void>(Time)>& set_time);
  std::optional<Time> SendClock(Time now);

  const RosOptions options_;
  const WireId participant_;
  const Clock& clock_;
  const ClockOffset offset_;
  std::vector<WireId> readers_;
  std::vector<WireId> writers_;
  bool has_told_ = false;
  std::unique_ptr<WireWriter> entities_;
  std::unique_ptr<WireWriter> time_;
  std::unique_ptr<WireWriter> log_;
  Time last_time_{Duration(-1)};
  std::unique_ptr<LogSink> sink_;
  std::unique_ptr<WireReader> followed_;
  std::unique_ptr<DiagnosticsTopic> diagnostics_;
  std::unique_ptr<ParameterServices> parameters_;
  std::unique_ptr<StopService> stop_;
};

}  // namespace runnel
