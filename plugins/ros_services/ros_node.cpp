#include "plugins/ros_services/ros_node.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "core/log/logger.h"
#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"
#include "plugins/ros_messages/node_messages.h"
#include "plugins/ros_services/ros_time.h"

namespace runnel {

namespace {

constexpr auto kClockPeriod = std::chrono::milliseconds(10);

void PutTime(CdrWriter& to, Time time) {
  const std::int64_t count = time.time_since_epoch().count();
  to.Put(static_cast<std::int32_t>(count / 1'000'000'000));
  to.Put(static_cast<std::uint32_t>(count % 1'000'000'000));
}

// Up to Humble they have 24 octets, the last of which are 0.
void PutId(CdrWriter& to, const WireId& id, bool is_long) {
  to.PutPlain(id.data(), 1, id.size());
  constexpr std::array<std::uint8_t, 8> kRest{};
  if (is_long) to.PutPlain(kRest.data(), 1, kRest.size());
}

}  // namespace

const std::vector<std::string>& RosParameterUses() {
  static const std::vector<std::string> names = {"none", "read", "write"};
  return names;
}

Result<std::unique_ptr<RosNode>> RosNode::Start(const RosOptions& options, WireParticipant& participant,
                                                FrameworkElement& application, bool is_simulated, Logger& log,
                                                RosHooks hooks, std::function<void()> on_news) {
  Runtime& runtime = application.runtime();
  std::unique_ptr<RosNode> node(new RosNode(options, participant.id(), runtime.clock()));
  if (auto done = node->MakeTopics(participant, runtime, is_simulated); !done) return done.error();
  if (options.follows_clock && hooks.set_time) {
    if (auto done = node->FollowClock(participant, log, hooks.set_time); !done) return done.error();
  }
  if (options.sends_diagnostics && hooks.health) {
    auto made = DiagnosticsTopic::Start(participant, runtime.clock(), is_simulated, std::move(hooks.health), std::move(on_news));
    if (!made) return made.error();
    node->diagnostics_ = std::move(*made);
  }
  if (options.parameters != RosParameterUse::kNone) {
    const bool may_set = options.parameters == RosParameterUse::kWrite;
    auto made = ParameterServices::Start(application, options.node, participant, hooks.dialect,
                                         may_set ? std::move(hooks.set_parameters) : ParameterSetter(), log);
    if (!made) return made.error();
    node->parameters_ = std::move(*made);
  }
  auto stop = StopService::Start(runtime, options.stop_releases, options.node, participant, hooks.dialect);
  if (!stop) return stop.error();
  node->stop_ = std::move(*stop);
  return node;
}

Result<void> RosNode::MakeTopics(WireParticipant& participant, Runtime& runtime, bool is_simulated) {
  const auto make = [&](std::unique_ptr<WireWriter>& writer, const WireEndpointOptions& endpoint) -> Result<void> {
    auto made = participant.MakeWriter(endpoint, {});
    if (!made) return made.error();
    writer = std::move(*made);
    return {};
  };
  Result<void> done;
  if (!options_.distribution.empty()) {
    done = make(entities_, {.topic = "ros_discovery_info",
                            .type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
                            .qos = {.is_latched = true}});
  }
  if (done && options_.sends_clock) {
    done = make(time_, {.topic = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_", .qos = {.is_reliable = false}});
  }
  if (done && options_.sends_log) {
    done = make(log_, {.topic = "rt/rosout",
                       .type = "rcl_interfaces::msg::dds_::Log_",
                       .qos = {.is_latched = true, .depth = 1000}});
    if (done) {
      sink_ = std::make_unique<LogSink>(runtime,
                                        [this, is_simulated](const LogMessage& message) { Say(message, is_simulated); });
    }
  }
  return done;
}

Result<void> RosNode::FollowClock(WireParticipant& participant, Logger& log,
                                  const std::function<Result<void>(Time)>& set_time) {
  const auto take = [&log, set_time, said = std::string()](const WireSample& sample) mutable {
    auto from = CdrReader::Begin(sample.octets);
    std::int32_t seconds = 0;
    std::uint32_t rest = 0;
    if (!from || !from->Get(seconds) || !from->Get(rest) || rest >= 1'000'000'000) return;
    const auto set = set_time(Time(std::chrono::seconds(seconds) + std::chrono::nanoseconds(rest)));
    const std::string why = set ? std::string() : set.error().ToString();
    if (why == said) return;
    said = why;
    if (!why.empty()) log.Warn("/clock is not followed: {}", why);
  };
  auto reader = participant.MakeReader(
      {.topic = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_", .qos = {.is_reliable = false}}, take, {});
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
  readers.push_back(stop_->endpoints().reader_id());
  writers.push_back(stop_->endpoints().writer_id());
  if (entities_ == nullptr || (has_told_ && readers == readers_ && writers == writers_)) return;
  has_told_ = true;
  readers_ = std::move(readers);
  writers_ = std::move(writers);
  const bool is_long = options_.distribution == "humble";
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
  const auto clock = SendClock(now);
  const auto health = diagnostics_ != nullptr ? diagnostics_->Send(now) : std::nullopt;
  return clock && health ? std::min(clock, health) : clock ? clock : health;
}

std::optional<Time> RosNode::SendClock(Time now) {
  if (time_ == nullptr) return {};
  const Time time = clock_.Now();
  if (time != last_time_) {
    last_time_ = time;
    auto octets = std::make_shared<Octets>();
    CdrWriter to(*octets);
    PutTime(to, time);
    (void)time_->Write(octets, SinceEpoch().time_since_epoch().count());
  }
  return now + kClockPeriod;
}

void RosNode::Say(const LogMessage& message, bool is_simulated) {
  auto octets = std::make_shared<Octets>();
  CdrWriter to(*octets);
  const Duration offset = is_simulated ? Duration() : SinceEpoch() - clock_.Now();
  PutTime(to, message.time + offset);
  to.Put(RosLevel(message.level));
  to.PutText(message.path);
  to.PutText(message.text);
  to.PutText("");
  to.PutText("");
  to.Put(std::uint32_t{0});
  (void)log_->Write(octets, SinceEpoch().time_since_epoch().count());
}

}  // namespace runnel
