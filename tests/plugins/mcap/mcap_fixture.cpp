#include "tests/plugins/mcap/mcap_fixture.h"

#include <fstream>
#include <iterator>

namespace runnel::test {

std::string McapTest::WriteFile(const std::string& name, const std::string& compression, int messages, bool finish,
                                std::size_t chunk_bytes) {
  auto writer = Must(McapWriter::Create(
      Path(name), {.header = {"runnel", "a test"}, .compression = compression, .chunk_bytes = chunk_bytes}));
  Must(writer->AddMetadata({"about", {{"clock", "simulated"}, {"seed", "7"}}}));
  Must(writer->AddAttachment({5, 6, "app.xml", "application/xml", "<application/>\n"}));
  const auto schema = Must(writer->AddSchema("Pose2", "jsonschema", R"({"type":"object"})"));
  const auto pose = Must(writer->AddChannel(schema, "/robot/pose", "json", {{"unit", "m"}}));
  const auto number = Must(writer->AddChannel(0, "/number", "json", {}));
  for (int i = 0; i < messages; ++i) {
    const std::string data = "{\"x\":" + std::to_string(i) + "}";
    const auto time = static_cast<std::uint64_t>(i) * 1000;
    Must(writer->AddMessage({i % 5 == 4 ? number : pose, static_cast<std::uint32_t>(i), time, time, data}));
  }
  if (finish) Must(writer->Finish());
  return Path(name);
}

std::string McapTest::ReadBytes(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void McapTest::WriteBytes(const std::string& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

std::vector<ReadMessage> McapTest::ReadAll(McapReader& reader) {
  std::vector<ReadMessage> messages;
  Must(reader.ReadMessages([&](const McapMessage& message) -> Result<void> {
    messages.push_back({message.channel, message.sequence, message.log_time, std::string(message.data)});
    return {};
  }));
  return messages;
}

}  // namespace runnel::test
