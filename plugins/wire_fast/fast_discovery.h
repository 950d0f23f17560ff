#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/rtps/common/Guid.h>

#include "core/base/error.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// From now on what Fast DDS has to say goes to nobody's terminal.
void HearFastLog();
/// And why others are not let in is kept, too.
void HearFastSecurity();
/// Why somebody has not been let in, as Fast DDS has said since this was last asked; "" if it has not.
[[nodiscard]] std::string TakeFastRefusal();
/// `what`, with what Fast DDS has said since it was last asked.
[[nodiscard]] Error FastError(const std::string& what);

[[nodiscard]] WireId IdOf(const eprosima::fastrtps::rtps::GUID_t& guid);
/// WireEndpoint::handle.
[[nodiscard]] std::uint64_t HandleOf(const WireId& id);
/// Whether both are, or are of, one participant.
[[nodiscard]] bool AreOfOneMember(const WireId& a, const WireId& b);

/// Tells of members and endpoints what Fast DDS says of others, and what is said here of this participant's own.
///
/// Threads: any.
class FastDiscovery final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  explicit FastDiscovery(WireDiscovery& listener) : listener_(listener) {}

  void TellMember(const WireMember& member);
  void Tell(const WireEndpoint& endpoint);
  void TellGone(const WireId& endpoint);

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* participant,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;

 private:
  template <typename Do>
  void TellOrMiss(const Do& tell);
  void TellMemberGone(const WireId& id);

  WireDiscovery& listener_;
  std::mutex mutex_;                     // Fast DDS calls from several threads
  std::set<WireId> endpoints_;           // that have been told
  std::map<WireId, std::string> names_;  // of members
};

}  // namespace runnel
