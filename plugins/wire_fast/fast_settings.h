#pragma once

#include <memory>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "core/base/result.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// `kept`: told of a socket of the participant that cannot be kept within reach. Errors: there is no such interface, or
/// address.
[[nodiscard]] Result<eprosima::fastdds::dds::DomainParticipantQos> MemberQos(const WireMemberOptions& options,
                                                                             std::shared_ptr<Result<void>> kept);
[[nodiscard]] eprosima::fastdds::dds::DataWriterQos WriterQosOf(const WireEndpointOptions& options);
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos ReaderQosOf(const WireEndpointOptions& options);

}  // namespace runnel
