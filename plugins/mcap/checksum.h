#pragma once

#include <cstdint>
#include <string_view>

namespace runnel {

/// The CRC-32 of zlib and IEEE 802.3 over what it has been given so far, which MCAP has throughout.
class Checksum {
 public:
  void Add(std::string_view bytes) noexcept;
  [[nodiscard]] std::uint32_t value() const noexcept { return value_; }

 private:
  std::uint32_t value_ = 0;
};

[[nodiscard]] inline std::uint32_t ChecksumOf(std::string_view bytes) noexcept {
  Checksum checksum;
  checksum.Add(bytes);
  return checksum.value();
}

}  // namespace runnel
