#include "plugins/wire_fast/fast_discovery.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include <fastdds/dds/log/Log.hpp>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

namespace runnel {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

using dds::Log;

struct Said {
  std::mutex mutex;
  std::string last;
  std::string refusal;
};

// Never destroyed: Fast DDS's thread may speak when the process ends.
Said& LastSaid() {
  static auto* const said = new Said;
  return *said;
}

class Listener final : public dds::LogConsumer {
 public:
  void Consume(const Log::Entry& entry) override {
    CallBack([&] {
      const std::lock_guard lock(LastSaid().mutex);
      if (entry.kind == Log::Error) LastSaid().last = entry.message;
      // Others of its kinds are told of values, again and again.
      if (std::string_view(entry.context.category) == "SECURITY_AUTHENTICATION") LastSaid().refusal = entry.message;
    });
  }
};

constexpr std::size_t kPrefix = rtps::GuidPrefix_t::size;  // of a participant's id, which those of its endpoints share

std::string TextOf(const dds::UserDataQosPolicy& user_data) { return {user_data.begin(), user_data.end()}; }

template <typename Proxy>
WireEndpoint EndpointOf(const Proxy& proxy, bool is_writer) {
  WireEndpoint endpoint{.id = IdOf(proxy.guid()), .is_writer = is_writer};
  endpoint.handle = HandleOf(endpoint.id);
  endpoint.participant = IdOf({proxy.guid().guidPrefix, rtps::c_EntityId_RTPSParticipant});
  endpoint.options.topic = proxy.topicName().to_string();
  endpoint.options.type = proxy.typeName().to_string();
  endpoint.options.user_data = TextOf(proxy.m_qos.m_userData);
  WireQos& qos = endpoint.options.qos;
  qos.is_reliable = proxy.m_qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS;
  qos.is_latched = proxy.m_qos.m_durability.kind != dds::VOLATILE_DURABILITY_QOS;
  qos.is_exclusive = proxy.m_qos.m_ownership.kind == dds::EXCLUSIVE_OWNERSHIP_QOS;
  const auto& representations = proxy.m_qos.representation.m_value;
  endpoint.options.unmet =
      OtherPolicies{.durability = proxy.m_qos.m_durability.kind,
                    .liveliness = proxy.m_qos.m_liveliness.kind,
                    .has_deadline = proxy.m_qos.m_deadline.period != eprosima::fastrtps::c_TimeInfinite,
                    .has_lease = proxy.m_qos.m_liveliness.lease_duration != eprosima::fastrtps::c_TimeInfinite,
                    .partitions = proxy.m_qos.m_partition.names(),
                    .representations = {representations.begin(), representations.end()}}
          .Unmet(is_writer);
  return endpoint;
}

}  // namespace

void HearFastLog() {
  static const bool hears = [] {
    Log::ClearConsumers();
    Log::SetVerbosity(Log::Error);
    Log::RegisterConsumer(std::make_unique<Listener>());
    return true;
  }();
  (void)hears;
}

void HearFastSecurity() { Log::SetVerbosity(Log::Warning); }

std::string TakeFastRefusal() {
  Log::Flush();
  const std::lock_guard lock(LastSaid().mutex);
  return std::exchange(LastSaid().refusal, {});
}

Error FastError(const std::string& what) {
  Log::Flush();
  const std::lock_guard lock(LastSaid().mutex);
  const std::string said = std::exchange(LastSaid().last, {});
  return {.message = what + (said.empty() ? "" : ": " + said)};
}

WireId IdOf(const rtps::GUID_t& guid) {
  WireId id;
  std::memcpy(id.data(), guid.guidPrefix.value, kPrefix);
  std::memcpy(id.data() + kPrefix, guid.entityId.value, rtps::EntityId_t::size);
  return id;
}

// FNV-1a: ids have twice as many octets.
std::uint64_t HandleOf(const WireId& id) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::uint8_t octet : id) hash = (hash ^ octet) * 0x100000001b3;
  return hash;
}

bool AreOfOneMember(const WireId& a, const WireId& b) { return std::equal(a.begin(), a.begin() + kPrefix, b.begin()); }

void FastDiscovery::TellMember(const WireMember& member) {
  const std::lock_guard lock(mutex_);
  names_[member.id] = member.name;
  listener_.OnMember(member);
}

void FastDiscovery::Tell(const WireEndpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  endpoints_.insert(endpoint.id);
  listener_.OnEndpoint(endpoint);
}

void FastDiscovery::TellGone(const WireId& endpoint) {
  const std::lock_guard lock(mutex_);
  if (endpoints_.erase(endpoint) > 0) listener_.OnEndpointGone(endpoint);
}

// Not all of its endpoints are said to have gone.
void FastDiscovery::TellMemberGone(const WireId& id) {
  const std::lock_guard lock(mutex_);
  std::erase_if(endpoints_, [&](const WireId& each) {
    const bool goes = AreOfOneMember(each, id);
    if (goes) listener_.OnEndpointGone(each);
    return goes;
  });
  names_.erase(id);
  listener_.OnMemberGone(id);
}

template <typename Do>
void FastDiscovery::TellOrMiss(const Do& tell) {
  if (!CallBack(tell)) listener_.OnMissed();
}

void FastDiscovery::on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& info) {
  const WireId id = IdOf(info.info.m_guid);
  TellOrMiss([&] {
    switch (info.status) {
      case rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT:
      case rtps::ParticipantDiscoveryInfo::CHANGED_QOS_PARTICIPANT:
        return TellMember(
            {.id = id, .name = info.info.m_participantName.to_string(), .user_data = TextOf(info.info.m_userData)});
      case rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT:
      case rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT:
        return TellMemberGone(id);
    }
  });
}

void FastDiscovery::onParticipantAuthentication(dds::DomainParticipant*, rtps::ParticipantAuthenticationInfo&& info) {
  if (info.status != rtps::ParticipantAuthenticationInfo::UNAUTHORIZED_PARTICIPANT) return;
  CallBack([&] {
    const std::string why = TakeFastRefusal();
    const std::lock_guard lock(mutex_);
    const auto known = names_.find(IdOf(info.guid));  // whoever is refused may never have been told of
    const bool has_name = known != names_.end() && !known->second.empty();
    listener_.OnRefused((has_name ? known->second : "somebody") + ": " +
                        (why.empty() ? "no certificate that is trusted here" : why));
  });
}

void FastDiscovery::on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) {
  TellOrMiss([&] {
    if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER) return TellGone(IdOf(info.info.guid()));
    Tell(EndpointOf(info.info, false));
  });
}

void FastDiscovery::on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) {
  TellOrMiss([&] {
    if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) return TellGone(IdOf(info.info.guid()));
    WireEndpoint endpoint = EndpointOf(info.info, true);
    endpoint.options.qos.strength = static_cast<std::int32_t>(info.info.m_qos.m_ownershipStrength.value);
    Tell(endpoint);
  });
}

}  // namespace runnel
