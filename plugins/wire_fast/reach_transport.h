#pragma once

#include <memory>

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include "plugins/wire/wire.h"

namespace runnel {

/// Sockets as those of `low`, which hear nothing until the filters of the member's reach are at them (KeepWithinReach()).
[[nodiscard]] std::shared_ptr<eprosima::fastdds::rtps::ChainingTransportDescriptor> WithinReach(
    std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> low, const WireMemberOptions& options);

}  // namespace runnel
