#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>

#include "core/base/result.h"
#include "plugins/wire/wire.h"
#include "plugins/wire_fast/fast_discovery.h"

namespace runnel {

/// What the endpoints of a participant share: its topics, of which Fast DDS wants one of a name.
///
/// Threads: any.
class FastMember {
 public:
  FastMember(eprosima::fastdds::dds::DomainParticipant& participant, FastDiscovery& discovery);
  ~FastMember();

  /// To be given back. Errors: it is there already, of another type.
  Result<eprosima::fastdds::dds::Topic*> TakeTopic(const std::string& name, const std::string& type);
  void GiveBack(eprosima::fastdds::dds::Topic* topic);

  [[nodiscard]] const WireId& id() const noexcept { return id_; }
  [[nodiscard]] FastDiscovery& discovery() const noexcept { return discovery_; }
  [[nodiscard]] eprosima::fastdds::dds::Publisher& publisher() const noexcept { return *publisher_; }
  [[nodiscard]] eprosima::fastdds::dds::Subscriber& subscriber() const noexcept { return *subscriber_; }

 private:
  eprosima::fastdds::dds::DomainParticipant& participant_;
  FastDiscovery& discovery_;
  const WireId id_;
  eprosima::fastdds::dds::Publisher* publisher_;
  eprosima::fastdds::dds::Subscriber* subscriber_;
  std::mutex mutex_;
  std::map<eprosima::fastdds::dds::Topic*, int> topics_;  // how many have each
};

[[nodiscard]] Result<std::unique_ptr<WireWriter>> MakeFastWriter(FastMember& member, const WireEndpointOptions& options,
                                                                 OnMatched on_matched);
[[nodiscard]] Result<std::unique_ptr<WireReader>> MakeFastReader(FastMember& member, const WireEndpointOptions& options,
                                                                 OnSample on_sample, OnMatched on_matched);

}  // namespace runnel
