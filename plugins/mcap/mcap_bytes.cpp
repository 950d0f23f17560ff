#include "plugins/mcap/mcap_bytes.h"

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

}  // namespace runnel
