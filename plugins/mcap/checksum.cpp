#include "plugins/mcap/checksum.h"

#include <zlib.h>

namespace runnel {

void Checksum::Add(std::string_view bytes) noexcept {
  // Without bytes zlib would begin anew.
  if (bytes.empty()) return;
  value_ = static_cast<std::uint32_t>(
      crc32_z(value_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace runnel
