#include "plugins/ros_services/ros_node.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "core/log/logger.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/network_discovery/value_form.h"

namespace runnel {

namespace {

constexpr auto kClockPeriod = std::chrono::milliseconds(10);
constexpr std::string_view kLastWithLongIds = "humble";

template <typename T>
void Write(WireWriter& to, const T& message) {
  const auto octets = std::make_shared<Octets>();
  WriteCdr(TypeOf<T>(), &message, *octets);
  (void)to.Write(octets, SinceEpoch().time_since_epoch().count());
}

// Up to Humble they have 24 octets, the last of which are 0.
void PutId(CdrWriter& to, const WireId& id, bool is_long) {
  to.PutPlain(id.data(), 1, id.size());
  constexpr std::array<std::uint8_t, 8> kRest{};
  if (is_long) to.PutPlain(kRest.data(), 1, kRest.size());
}

constexpr auto kPeriod = std::chrono::seconds(1);
// So often it is looked whether it is better or worse.
constexpr auto kLook = std::chrono::milliseconds(100);

}  // namespace

const std::vector<std::string>& RosDistributions() {
  static const std::vector<std::string> names = {"foxy", "galactic", "humble", "iron", "jazzy", "kilted", "rolling"};
  return names;
}

const std::vector<std::string>& RosParameterUses() {
  static const std::vector<std::string> names = {"none", "read", "write"};
  return names;
}

std::unique_ptr<RosNode> RosNode::Start(const RosOptions& options, WireParticipant& participant,
                                        FrameworkElement& application, bool is_simulated, Logger& log, RosHooks hooks,
                                        std::function<void()> on_news) {
  Runtime& runtime = application.runtime();
  const ClockOffset offset{is_simulated, hooks.clock_lead};
  std::unique_ptr<RosNode> node(new RosNode(options, participant.id(), runtime.clock(), offset));
  const auto tell = [&](const Error& error) { log.Warn("nodes of ROS 2 are told less: {}", error.ToString()); };
  const auto keep = [&](auto& place, auto made) {
    if (!made) return tell(made.error());
    place = std::move(*made);
  };
  node->MakeTopics(participant, runtime, tell);
  if (options.follows_clock && hooks.set_time) {
    if (const auto done = node->FollowClock(participant, hooks.set_time); !done) tell(done.error());
  }
  if (options.sends_diagnostics && hooks.health) {
    keep(node->diagnostics_,
         DiagnosticsTopic::Start(participant, runtime.clock(), offset, std::move(hooks.health), std::move(on_news)));
  }
  if (options.parameters != RosParameterUse::kNone) {
    const bool may_set = options.parameters == RosParameterUse::kWrite;
    keep(node->parameters_,
         ParameterServices::Start(application, options.node, participant, hooks.dialect,
                                  may_set ? std::move(hooks.set_parameters) : ParameterSetter(), log, hooks.table));
  }
  keep(node->stop_, StopService::Start(runtime, options.stop_releases, options.node, participant, hooks.dialect,
                                       std::move(hooks.is_stop_kept), std::move(hooks.check_stop), hooks.table));
  return node;
}

void RosNode::MakeTopics(WireParticipant& participant, Runtime& runtime,
                         const std::function<void(const Error&)>& tell) {
  const auto make = [&](bool is_wanted, std::unique_ptr<WireWriter>& writer, const WireEndpointOptions& endpoint) {
    if (!is_wanted) return;
    auto made = participant.MakeWriter(endpoint, {});
    if (!made) return tell(made.error());
    writer = std::move(*made);
  };
  make(!options_.distribution.empty(), entities_,
       {.topic = kNodesTopic, .type = kNodesType, .qos = {.is_latched = true}});
  make(options_.sends_clock, time_, RosEndpoint("/clock", "rosgraph_msgs/msg/Clock", {.is_reliable = false}));
  make(options_.sends_log, log_,
       RosEndpoint("/rosout", "rcl_interfaces/msg/Log",
                   {.is_latched = true, .depth = 1000, .lifespan = std::chrono::seconds(10)}));
  if (log_ != nullptr) {
    sink_ = std::make_unique<LogSink>(
        runtime, [this](const LogMessage& message) { Write(*log_, ToRosLog(message, message.time + offset_.Now())); });
  }
}

Result<void> RosNode::FollowClock(WireParticipant& participant, const std::function<Result<void>(Time)>& set_time) {
  const auto take = [set_time](const WireSample& sample) {
    auto from = CdrReader::Begin(sample.octets);
    std::int32_t seconds = 0;
    std::uint32_t rest = 0;
    if (!from || !from->Get(seconds) || !from->Get(rest) || rest >= 1'000'000'000) return;
    // Whoever follows no clock has not been let start.
    (void)set_time(Time(std::chrono::seconds(seconds) + std::chrono::nanoseconds(rest)));
  };
  auto reader =
      participant.MakeReader(RosEndpoint("/clock", "rosgraph_msgs/msg/Clock", {.is_reliable = false}), take, {});
  if (!reader) return reader.error();
  followed_ = std::move(*reader);
  return {};
}

void RosNode::Tell(std::vector<WireId> readers, std::vector<WireId> writers) {
  for (const auto* const own : {&time_, &log_}) {
    if (*own != nullptr) writers.push_back((*own)->id());
  }
  if (followed_ != nullptr) readers.push_back(followed_->id());
  if (diagnostics_ != nullptr) writers.push_back(diagnostics_->id());
  if (parameters_ != nullptr) parameters_->AddIds(readers, writers);
  if (stop_ != nullptr) {
    readers.push_back(stop_->endpoints().reader_id());
    writers.push_back(stop_->endpoints().writer_id());
    stop_->Serve();  // answers may wait for who has come
  }
  if (parameters_ != nullptr) parameters_->LookAgain();
  if (entities_ == nullptr || (has_told_ && readers == readers_ && writers == writers_)) return;
  has_told_ = true;
  readers_ = std::move(readers);
  writers_ = std::move(writers);
  const auto& distributions = RosDistributions();
  const bool is_long =
      std::ranges::find(distributions, options_.distribution) <= std::ranges::find(distributions, kLastWithLongIds);
  const std::size_t slash = options_.node.rfind('/');
  auto octets = std::make_shared<Octets>();
  CdrWriter to(*octets);
  PutId(to, participant_, is_long);
  to.PutCount(1);
  to.PutText(slash == 0 ? "/" : options_.node.substr(0, slash));
  to.PutText(options_.node.substr(slash + 1));
  for (const auto& ids : {readers_, writers_}) {
    to.PutCount(ids.size());
    for (const WireId& id : ids) PutId(to, id, is_long);
  }
  (void)entities_->Write(octets, SinceEpoch().time_since_epoch().count());
}

std::optional<Time> RosNode::Work(Time now) {
  if (stop_ != nullptr) stop_->ServeLeft();
  const auto clock = SendClock(now);
  const auto health = diagnostics_ != nullptr ? diagnostics_->Send(now) : std::nullopt;
  return clock && health ? std::min(clock, health) : clock ? clock : health;
}

std::optional<Time> RosNode::SendClock(Time now) {
  if (time_ == nullptr) return {};
  const Time time = clock_.Now();
  if (time != last_time_) {
    last_time_ = time;
    Write(*time_, time + offset_.Now());
  }
  return now + kClockPeriod;
}

Result<std::unique_ptr<DiagnosticsTopic>> DiagnosticsTopic::Start(WireParticipant& participant, const Clock& clock,
                                                                  ClockOffset offset, Health health,
                                                                  std::function<void()> on_news) {
  std::unique_ptr<DiagnosticsTopic> topic(new DiagnosticsTopic(clock, std::move(offset), std::move(health)));
  auto writer =
      participant.MakeWriter(RosEndpoint("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", {.depth = 10}),
                             [listeners = topic->listeners_, on_news = std::move(on_news)](std::size_t count) {
                               listeners->store(count, std::memory_order_relaxed);
                               on_news();
                             });
  if (!writer) return writer.error();
  topic->writer_ = std::move(*writer);
  return topic;
}

std::optional<Time> DiagnosticsTopic::Send(Time now) {
  if (listeners_->load(std::memory_order_relaxed) == 0) {
    told_at_.reset();  // who comes is told at once
    return {};
  }
  const Time time = clock_.Now();
  RosDiagnostics diagnostics;
  diagnostics.status = health_();
  std::vector<RosHealth> health;
  for (const RosDiagnosticStatus& each : diagnostics.status) health.push_back(each.level);
  if (!told_at_ || time - *told_at_ >= kPeriod || health != told_) {
    diagnostics.header.stamp = time + offset_.Now();
    Write(*writer_, diagnostics);
    told_at_ = time;
    told_ = std::move(health);
  }
  return now + kLook;
}

}  // namespace runnel
