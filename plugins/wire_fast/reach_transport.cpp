#include "plugins/wire_fast/reach_transport.h"

#include <atomic>
#include <chrono>
#include <utility>

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>

#include "plugins/wire/reach_filter.h"

namespace runnel {

namespace {

using namespace eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::octet;
using eprosima::fastrtps::rtps::SenderResource;

struct ReachDescriptor final : ChainingTransportDescriptor {
  ReachDescriptor(std::shared_ptr<TransportDescriptorInterface> low, const WireMemberOptions& said)
      : ChainingTransportDescriptor(std::move(low)), options(said) {}
  TransportInterface* create_transport() const override;

  const WireMemberOptions options;
};

class ReachTransport final : public ChainingTransport {
 public:
  explicit ReachTransport(const ReachDescriptor& descriptor) : ChainingTransport(descriptor), descriptor_(descriptor) {}

  TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  bool OpenInputChannel(const Locator_t& locator, TransportReceiverInterface* receiver, std::uint32_t most) override {
    hears_ = false;
    const bool is_open = ChainingTransport::OpenInputChannel(locator, receiver, most);
    (void)KeepWithinReach(descriptor_.options);  // what is wrong is told by who joins
    hears_ = true;
    return is_open;
  }
  bool send(SenderResource* low, const octet* octets, std::uint32_t size, LocatorsIterator* begin, LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& latest) override {
    return low->send(octets, size, begin, end, latest);
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

}  // namespace

std::shared_ptr<ChainingTransportDescriptor> WithinReach(std::shared_ptr<TransportDescriptorInterface> low,
                                                         const WireMemberOptions& options) {
  return std::make_shared<ReachDescriptor>(std::move(low), options);
}

}  // namespace runnel
