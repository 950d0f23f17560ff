#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/mcap/mcap_reader.h"
#include "plugins/mcap/mcap_writer.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {

/// What a message was, whole.
struct ReadMessage {
  std::uint16_t channel;
  std::uint32_t sequence;
  std::uint64_t time;
  std::string data;
  friend bool operator==(const ReadMessage&, const ReadMessage&) = default;
};

/// Files in a folder of the test's own.
class McapTest : public testing::Test {
 protected:
  [[nodiscard]] std::string Path(const std::string& name) const { return folder_ / name; }
  /// A file with two channels, `messages` messages and all that a file can have; chunks of about
  /// `chunk_bytes`. Without `finish`, as a killed process leaves it.
  std::string WriteFile(const std::string& name, const std::string& compression, int messages, bool finish = true,
                        std::size_t chunk_bytes = 300);

  [[nodiscard]] static std::string ReadBytes(const std::string& file);
  static void WriteBytes(const std::string& file, std::string_view bytes);
  [[nodiscard]] static std::vector<ReadMessage> ReadAll(McapReader& reader);

 private:
  TemporaryFolder folder_;
};

/// Fails the test if `result` is an error.
template <typename T>
T Must(Result<T> result) {
  EXPECT_TRUE(result) << result.error().ToString();
  return std::move(*result);
}
inline void Must(const Result<void>& result) { EXPECT_TRUE(result) << result.error().ToString(); }

}  // namespace runnel::test
