#include "plugins/wire_fast/fast_settings.h"

#include <atomic>
#include <chrono>
#include <utility>

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <netdb.h>
#include <sys/socket.h>

#include "plugins/wire/reach_filter.h"

namespace runnel {

namespace {

namespace dds = eprosima::fastdds::dds;
using namespace eprosima::fastdds::rtps;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::LocatorSelector;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::SenderResource;

/// Sockets as those of `low`, which hear nothing until the filters of the member's reach are at them (KeepWithinReach()).
/// Values go to no group.
struct ReachDescriptor final : ChainingTransportDescriptor {
  ReachDescriptor(std::shared_ptr<TransportDescriptorInterface> low, const WireMemberOptions& said,
                  std::shared_ptr<Result<void>> is_kept)
      : ChainingTransportDescriptor(std::move(low)), options(said), kept(std::move(is_kept)) {}
  TransportInterface* create_transport() const override;

  const WireMemberOptions options;
  const std::shared_ptr<Result<void>> kept;  // for who joins: the last error
};

class ReachTransport final : public ChainingTransport {
 public:
  explicit ReachTransport(const ReachDescriptor& descriptor) : ChainingTransport(descriptor), descriptor_(descriptor) {}

  TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  bool OpenInputChannel(const Locator_t& locator, TransportReceiverInterface* receiver, std::uint32_t most) override {
    hears_ = false;
    bool is_open = false;
    const auto kept = KeepWithinReach(descriptor_.options,
                                      [&] { is_open = ChainingTransport::OpenInputChannel(locator, receiver, most); });
    if (!kept) *descriptor_.kept = kept;
    hears_ = descriptor_.kept->has_value();
    return is_open;
  }
  bool send(SenderResource* low, const octet* octets, std::uint32_t size, LocatorsIterator* begin,
            LocatorsIterator* end, const std::chrono::steady_clock::time_point& latest) override {
    return low->send(octets, size, begin, end, latest);
  }
  // Each reader is sent to at its own addresses. Of two that share a group Fast DDS 2.9 would select the group alone, send to
  // the addresses all the same, and end the process by an assertion, as nothing is open to them.
  void select_locators(LocatorSelector& selector) const override {
    const auto& readers = selector.transport_starts();
    for (std::size_t i = 0; i < readers.size(); ++i) {
      auto& reader = *readers[i];
      const bool has_address = !reader.unicast.empty();
      const auto& places = has_address ? reader.unicast : reader.multicast;
      auto& selected = has_address ? reader.state.unicast : reader.state.multicast;
      for (std::size_t j = 0; reader.transport_should_process && j < places.size(); ++j) {
        if (selector.is_selected(places[j])) continue;
        selected.push_back(j);
        selector.select(i);
      }
    }
  }
  void receive(TransportReceiverInterface* next, const octet* octets, std::uint32_t size, const Locator_t& local,
               const Locator_t& remote) override {
    // relaxed: it guards no memory.
    if (hears_.load(std::memory_order_relaxed)) next->OnDataReceived(octets, size, local, remote);
  }

 private:
  ReachDescriptor descriptor_;
  std::atomic<bool> hears_{false};
};

TransportInterface* ReachDescriptor::create_transport() const { return new ReachTransport(*this); }

constexpr std::uint32_t kRoom = 4'194'304;           // of sockets: for images
constexpr std::uint32_t kProcessesOfAMachine = 120;  // that are asked one by one
constexpr std::uint32_t kMillisecond = 1'000'000;
constexpr const char* kGroup = "239.255.0.1";

Result<Locator_t> Peer(const std::string& name) {
  const addrinfo hints{.ai_flags = 0,
                       .ai_family = AF_INET,
                       .ai_socktype = SOCK_DGRAM,
                       .ai_protocol = 0,
                       .ai_addrlen = 0,
                       .ai_addr = nullptr,
                       .ai_canonname = nullptr,
                       .ai_next = nullptr};
  addrinfo* found = nullptr;
  if (const int failed = getaddrinfo(name.c_str(), nullptr, &hints, &found); failed != 0) {
    return Error{.message = "the address '" + name + "' is not known: " + gai_strerror(failed)};
  }
  Locator_t locator(LOCATOR_KIND_UDPv4, 0);  // port 0: all that it may have
  IPLocator::setIPv4(locator, AddressText(*found->ai_addr));
  freeaddrinfo(found);
  return locator;
}

template <typename Qos>
void SetKept(Qos& qos, const WireQos& wanted) {
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  const auto depth = static_cast<std::int32_t>(wanted.depth);
  qos.history().depth = depth;
  qos.resource_limits().max_samples = depth;
  qos.resource_limits().max_instances = 1;
  qos.resource_limits().max_samples_per_instance = depth;
  qos.resource_limits().allocated_samples = 1;
  qos.reliability().kind = wanted.is_reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = wanted.is_latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.ownership().kind = wanted.is_exclusive ? dds::EXCLUSIVE_OWNERSHIP_QOS : dds::SHARED_OWNERSHIP_QOS;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
}

void SetUserData(dds::UserDataQosPolicy& user_data, const std::string& text) {
  user_data.data_vec({text.begin(), text.end()});
}

void SetSecurity(dds::DomainParticipantQos& qos, const WireSecurity& security) {
  const auto set = [&](const std::string& name, const std::string& value) {
    qos.properties().properties().emplace_back("dds.sec." + name, value);
  };
  const auto set_file = [&](const std::string& name, const std::string& file) { set(name, "file://" + file); };
  set("auth.plugin", "builtin.PKI-DH");
  set_file("auth.builtin.PKI-DH.identity_ca", security.identity_ca);
  set_file("auth.builtin.PKI-DH.identity_certificate", security.certificate);
  set_file("auth.builtin.PKI-DH.private_key", security.key);
  set("access.plugin", "builtin.Access-Permissions");
  set_file("access.builtin.Access-Permissions.permissions_ca", security.permissions_ca);
  set_file("access.builtin.Access-Permissions.governance", security.governance);
  set_file("access.builtin.Access-Permissions.permissions", security.permissions);
  set("crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace

// Every policy is set here: files of profiles in the folder of the process may change the defaults.
Result<dds::DomainParticipantQos> MemberQos(const WireMemberOptions& options, std::shared_ptr<Result<void>> kept) {
  dds::DomainParticipantQos qos;
  qos.name() = options.name;
  SetUserData(qos.user_data(), options.user_data);

  if (options.security) SetSecurity(qos, *options.security);

  const auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->sendBufferSize = kRoom;
  udp->receiveBufferSize = kRoom;
  // What members with keys say to begin with must not be cut.
  if (!options.security) udp->maxMessageSize = LargestDatagram(options);
  udp->maxInitialPeersRange = kProcessesOfAMachine;
  if (options.reach == WireReach::kLoopback) udp->interfaceWhiteList = {"127.0.0.1"};
  std::string here = "127.0.0.1";  // where others of this machine are asked
  if (!options.interface.empty()) {
    const auto address = AddressOfInterface(options.interface);
    if (!address) return address.error();
    udp->interfaceWhiteList = {*address};
    here = *address;  // they hear nothing elsewhere
  }
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(std::make_shared<ReachDescriptor>(udp, options, std::move(kept)));

  auto& builtin = qos.wire_protocol().builtin;
  builtin.discovery_config.leaseDuration = Duration_t(static_cast<long double>(ToSeconds(options.lease)));
  builtin.discovery_config.leaseDuration_announcementperiod = Duration_t(0, 500 * kMillisecond);
  builtin.discovery_config.initial_announcements = {10, Duration_t(0, 50 * kMillisecond)};
  builtin.typelookup_config.use_client = false;
  builtin.typelookup_config.use_server = false;

  const bool asks_all = options.has_multicast && options.reach != WireReach::kMachine;
  if (!asks_all) {
    builtin.metatrafficUnicastLocatorList.push_back(Locator_t(LOCATOR_KIND_UDPv4, 0));  // and no group
  }
  std::vector<std::string> peers = options.peers;
  if (!asks_all) peers.push_back(here);
  for (const std::string& each : peers) {
    const auto peer = Peer(each);
    if (!peer) return peer.error();
    builtin.initialPeersList.push_back(*peer);
  }
  if (asks_all && !peers.empty()) {  // else that is what it does by itself
    Locator_t group(LOCATOR_KIND_UDPv4, qos.wire_protocol().port.getMulticastPort(options.domain));
    IPLocator::setIPv4(group, kGroup);
    builtin.initialPeersList.push_back(group);
  }
  return qos;
}

dds::DataWriterQos WriterQosOf(const WireEndpointOptions& options) {
  dds::DataWriterQos qos;
  SetKept(qos, options.qos);
  SetUserData(qos.user_data(), options.user_data);
  qos.reliability().max_blocking_time = Duration_t(0, 2 * kMillisecond);
  if (options.qos.lifespan > Duration{})
    qos.lifespan().duration = Duration_t(static_cast<long double>(ToSeconds(options.qos.lifespan)));
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.ownership_strength().value = options.qos.is_exclusive ? static_cast<std::uint32_t>(options.qos.strength) : 0;
  auto& times = qos.reliable_writer_qos().times;
  times.heartbeatPeriod = Duration_t(0, 100 * kMillisecond);
  times.nackResponseDelay = Duration_t(0, kMillisecond);
  return qos;
}

dds::DataReaderQos ReaderQosOf(const WireEndpointOptions& options) {
  dds::DataReaderQos qos;
  SetKept(qos, options.qos);
  SetUserData(qos.user_data(), options.user_data);
  qos.reliable_reader_qos().times.heartbeatResponseDelay = Duration_t(0, kMillisecond);
  return qos;
}

}  // namespace runnel
