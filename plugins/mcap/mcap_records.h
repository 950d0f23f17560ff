#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace runnel {

/// What a file of the format MCAP, version 0, is made of (https://mcap.dev/spec). Times are
/// nanoseconds, numbers little-endian, texts UTF-8.

inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
inline constexpr std::uint64_t kFooterLength = 8 + 8 + 4;

/// The first byte of each record; a length of 64 bits follows, then the content.
enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Of opcode and length.
inline constexpr std::uint64_t kMcapRecordHead = 9;

using McapTexts = std::vector<std::pair<std::string, std::string>>;

/// The text under `key`; nullptr if there is none.
[[nodiscard]] inline const std::string* FindText(const McapTexts& texts, std::string_view key) {
  for (const auto& [name, text] : texts) {
    if (name == key) return &text;
  }
  return nullptr;
}

struct McapHeader {
  std::string profile;
  std::string library;
};

/// What the messages of a channel look like. 0 is no id.
struct McapSchema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  ///< 0: none
  std::string topic;
  std::string message_encoding;
  McapTexts metadata;
};

/// `data` belongs to somebody else.
struct McapMessage {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;
  std::uint64_t publish_time = 0;
  std::string_view data;
};

struct McapMetadata {
  std::string name;
  McapTexts texts;
};

struct McapAttachment {
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;
  std::string name;
  std::string media_type;
  std::string data;
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t metadata = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::map<std::uint16_t, std::uint64_t> messages_of;  ///< by channel
};

}  // namespace runnel
