#include "plugins/network/ros_node.h"

#include <array>
#include <chrono>
#include <utility>

#include "plugins/cdr_values/cdr_writer.h"
#include "plugins/ros_messages/node_messages.h"

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

std::int64_t SinceEpoch() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

Result<std::unique_ptr<RosNode>> RosNode::Start(const RosOptions& options, WireParticipant& participant,
                                                Runtime& runtime, bool is_simulated) {
  std::unique_ptr<RosNode> node(new RosNode(options, participant.id(), runtime.clock()));
  const auto make = [&](std::unique_ptr<WireWriter>& writer, const WireEndpointOptions& endpoint) -> Result<void> {
    auto made = participant.MakeWriter(endpoint, {});
    if (!made) return made.error();
    writer = std::move(*made);
    return {};
  };
  Result<void> done;
  if (!options.distribution.empty()) {
    done = make(node->entities_, {.topic = "ros_discovery_info",
                                  .type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
                                  .qos = {.is_latched = true}});
  }
  if (done && options.sends_clock) {
    done = make(node->time_, {.topic = "rt/clock", .type = "rosgraph_msgs::msg::dds_::Clock_", .qos = {.is_reliable = false}});
  }
  if (done && options.sends_log) {
    done = make(node->log_, {.topic = "rt/rosout",
                             .type = "rcl_interfaces::msg::dds_::Log_",
                             .qos = {.is_latched = true, .depth = 1000}});
    if (done) {
      node->sink_ = std::make_unique<LogSink>(
          runtime, [raw = node.get(), is_simulated](const LogMessage& message) { raw->Say(message, is_simulated); });
    }
  }
  if (!done) return done.error();
  return node;
}

void RosNode::Tell(std::vector<WireId> readers, std::vector<WireId> writers) {
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
  (void)entities_->Write(octets, SinceEpoch());
}

std::optional<Time> RosNode::SendClock(Time now) {
  if (time_ == nullptr) return {};
  const Time time = clock_.Now();
  if (time != last_time_) {
    last_time_ = time;
    auto octets = std::make_shared<Octets>();
    CdrWriter to(*octets);
    PutTime(to, time);
    (void)time_->Write(octets, SinceEpoch());
  }
  return now + kClockPeriod;
}

void RosNode::Say(const LogMessage& message, bool is_simulated) {
  auto octets = std::make_shared<Octets>();
  CdrWriter to(*octets);
  const Duration offset = is_simulated ? Duration() : Duration(SinceEpoch()) - clock_.Now().time_since_epoch();
  PutTime(to, message.time + offset);
  to.Put(RosLevel(message.level));
  to.PutText(message.path);
  to.PutText(message.text);
  to.PutText("");
  to.PutText("");
  to.Put(std::uint32_t{0});
  (void)log_->Write(octets, SinceEpoch());
}

}  // namespace runnel
