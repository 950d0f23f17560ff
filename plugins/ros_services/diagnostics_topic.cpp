#include "plugins/ros_services/diagnostics_topic.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_services/ros_time.h"

namespace runnel {

namespace {

constexpr auto kPeriod = std::chrono::seconds(1);
// So often it is looked whether it is better or worse.
constexpr auto kLook = std::chrono::milliseconds(100);

}  // namespace

Result<std::unique_ptr<DiagnosticsTopic>> DiagnosticsTopic::Start(WireParticipant& participant, const Clock& clock,
                                                                  bool is_simulated, Health health,
                                                                  std::function<void()> on_news) {
  std::unique_ptr<DiagnosticsTopic> topic(new DiagnosticsTopic(clock, is_simulated, std::move(health)));
  auto writer = participant.MakeWriter({.topic = "rt/diagnostics",
                                        .type = "diagnostic_msgs::msg::dds_::DiagnosticArray_",
                                        .qos = {.depth = 10}},
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
    diagnostics.header.stamp = is_simulated_ ? time : SinceEpoch();
    const auto octets = std::make_shared<Octets>();
    WriteCdr(TypeOf<RosDiagnostics>(), &diagnostics, *octets);
    (void)writer_->Write(octets, SinceEpoch().time_since_epoch().count());
    told_at_ = time;
    told_ = std::move(health);
  }
  return now + kLook;
}

}  // namespace runnel
