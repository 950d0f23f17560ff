#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>

namespace runnel::test {

/// A message in a structure that Cyclone's compiler has made, read and written by Cyclone's code.
class CycloneSample {
 public:
  explicit CycloneSample(const dds_topic_descriptor_t& type) : type_(type), sample_(type.m_size) {}
  CycloneSample(const CycloneSample&) = delete;
  CycloneSample& operator=(const CycloneSample&) = delete;
  ~CycloneSample() { dds_stream_free_sample(sample_.data(), type_.m_ops); }

  /// False if Cyclone would refuse them, or leaves some over.
  bool Read(std::vector<std::byte> octets) {
    std::vector<char> body(octets.size() - kHeader);
    std::memcpy(body.data(), octets.data() + kHeader, body.size());
    const auto size = static_cast<std::uint32_t>(body.size());
    std::uint32_t place = 0;
    if (dds_stream_normalize_data(body.data(), &place, size, false, kVersion, type_.m_ops) == nullptr) return false;
    if (place != size) return false;
    dds_istream_t stream;
    dds_istream_init(&stream, size, body.data(), kVersion);
    dds_stream_read(&stream, sample_.data(), type_.m_ops);
    dds_istream_fini(&stream);
    return true;
  }

  std::vector<std::byte> Write() const {
    dds_ostream_t stream;
    dds_ostream_init(&stream, 0, kVersion);
    dds_stream_write(&stream, sample_.data(), type_.m_ops);
    std::vector<std::byte> octets(kHeader + stream.m_index);
    octets[1] = std::byte{1};
    std::memcpy(octets.data() + kHeader, stream.m_buffer, stream.m_index);
    dds_ostream_fini(&stream);
    return octets;
  }

  template <typename Message>
  Message& as() {
    return *reinterpret_cast<Message*>(sample_.data());
  }

 private:
  static constexpr std::size_t kHeader = 4;
  static constexpr std::uint32_t kVersion = 1;  // of XCDR

  const dds_topic_descriptor_t& type_;
  std::vector<char> sample_;
};

}  // namespace runnel::test
