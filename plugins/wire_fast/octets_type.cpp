#include "plugins/wire_fast/octets_type.h"

#include <cstring>

#include <fastdds/rtps/common/SerializedPayload.h>

namespace runnel {

namespace {

constexpr std::uint32_t kUsualSize = 256;  // room grows where values are larger
constexpr std::size_t kEncapsulation = 4;

}  // namespace

OctetsType::OctetsType(const std::string& name) {
  setName(name.c_str());
  m_typeSize = kUsualSize;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool OctetsType::serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) {
  const auto& octets = *static_cast<const Octets*>(data);
  if (octets.size() < kEncapsulation || octets.size() > payload->max_size) return false;
  std::memcpy(payload->data, octets.data(), octets.size());
  payload->length = static_cast<std::uint32_t>(octets.size());
  payload->encapsulation = octets[1] == std::byte{1} ? CDR_LE : CDR_BE;
  return true;
}

// The length is read once: in memory that processes share it may change meanwhile.
bool OctetsType::deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) {
  const std::uint32_t length = payload->length;
  if (length < kEncapsulation || length > payload->max_size) return false;
  const auto* const begin = reinterpret_cast<const std::byte*>(payload->data);
  static_cast<Octets*>(data)->assign(begin, begin + length);
  return true;
}

std::function<std::uint32_t()> OctetsType::getSerializedSizeProvider(void* data) {
  return [size = static_cast<std::uint32_t>(static_cast<const Octets*>(data)->size())] { return size; };
}

void* OctetsType::createData() { return new Octets; }
void OctetsType::deleteData(void* data) { delete static_cast<Octets*>(data); }

// Values without keys are all of one instance.
bool OctetsType::getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) { return false; }

}  // namespace runnel
