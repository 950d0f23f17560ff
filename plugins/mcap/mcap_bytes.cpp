#include "plugins/mcap/mcap_bytes.h"

#include <zlib.h>

namespace runnel {

McapBytesWriter& McapBytesWriter::Texts(const McapTexts& texts) {
  std::string all;
  McapBytesWriter writer(all);
  for (const auto& [key, value] : texts) writer.Text(key).Text(value);
  return Text(all);
}

McapBytesReader& McapBytesReader::Texts(McapTexts& texts) {
  McapBytesReader reader(View());
  while (!reader.rest().empty()) {
    auto& [key, value] = texts.emplace_back();
    reader.Text(key).Text(value);
  }
  has_failed_ = has_failed_ || reader.has_failed();
  return *this;
}

void Checksum::Add(std::string_view bytes) noexcept {
  // Without bytes zlib would begin anew.
  if (bytes.empty()) return;
  value_ = static_cast<std::uint32_t>(crc32_z(value_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace runnel
