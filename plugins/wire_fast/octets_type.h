#pragma once

#include <string>

#include <fastdds/dds/topic/TopicDataType.hpp>

#include "plugins/wire/wire.h"

namespace runnel {

/// A type of which only the name is known: what is written is `const Octets`, what is read `Octets`.
class OctetsType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit OctetsType(const std::string& name);

  bool serialize(void* octets, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* octets) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* octets) override;
  void* createData() override;
  void deleteData(void* octets) override;
  bool getKey(void* octets, eprosima::fastrtps::rtps::InstanceHandle_t* key, bool force_md5) override;
};

}  // namespace runnel
