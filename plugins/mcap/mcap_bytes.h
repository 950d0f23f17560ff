#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "plugins/mcap/mcap_records.h"

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

/// Appends what records are made of to a text.
class McapBytesWriter {
 public:
  explicit McapBytesWriter(std::string& bytes) : bytes_(bytes) {}

  template <std::unsigned_integral U>
  McapBytesWriter& Number(U number) {
    char little[sizeof(U)];
    for (std::size_t i = 0; i < sizeof(U); ++i) {
      little[i] = static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i));
    }
    bytes_.append(little, sizeof little);
    return *this;
  }
  /// With its length, 32 bits, before it.
  McapBytesWriter& Text(std::string_view text) { return Number(static_cast<std::uint32_t>(text.size())).Bytes(text); }
  McapBytesWriter& Bytes(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  McapBytesWriter& Texts(const McapTexts& texts);

 private:
  std::string& bytes_;
};

/// Appends one whole record, whose content `write(McapBytesWriter&)` writes.
template <typename Write>
void AppendMcapRecord(McapOpcode opcode, std::string& bytes, Write&& write) {
  McapBytesWriter writer(bytes);
  writer.Number(static_cast<std::uint8_t>(opcode)).Number(std::uint64_t{0});
  const std::size_t begin = bytes.size();
  write(writer);
  const std::uint64_t length = bytes.size() - begin;
  std::string little;
  McapBytesWriter(little).Number(length);
  bytes.replace(begin - sizeof length, sizeof length, little);
}

/// Takes what records are made of from the front of some bytes. What is not there is read as 0 or
/// empty, and has_failed() is true from then on: ask once, at the end.
class McapBytesReader {
 public:
  explicit McapBytesReader(std::string_view bytes) : bytes_(bytes) {}

  template <std::unsigned_integral U>
  McapBytesReader& Number(U& number) {
    std::uint64_t all = 0;
    const std::string_view little = Take(sizeof(U));
    for (std::size_t i = 0; i < little.size(); ++i) {
      all |= static_cast<std::uint64_t>(static_cast<unsigned char>(little[i])) << (8 * i);
    }
    number = static_cast<U>(all);
    return *this;
  }
  McapBytesReader& Text(std::string& text) {
    text = View();
    return *this;
  }
  /// The same within the bytes, with a length of 32 bits or, in front of large data, of 64.
  template <std::unsigned_integral Length = std::uint32_t>
  std::string_view View() {
    Length length = 0;
    Number(length);
    return Take(length);
  }
  McapBytesReader& Texts(McapTexts& texts);
  std::string_view Take(std::uint64_t count) {
    if (count > bytes_.size()) {
      has_failed_ = true;
      bytes_ = {};
      return {};
    }
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  [[nodiscard]] std::string_view rest() const noexcept { return bytes_; }
  [[nodiscard]] bool has_failed() const noexcept { return has_failed_; }

 private:
  std::string_view bytes_;
  bool has_failed_ = false;
};

// The fields of records in their order, for a McapBytesWriter as for a McapBytesReader.

/// Of a message; its data follow.
template <typename Bytes, typename Message>
Bytes& MessageHead(Bytes& bytes, Message& message) {
  return bytes.Number(message.channel).Number(message.sequence).Number(message.log_time).Number(message.publish_time);
}

/// Of statistics; the counts by channel follow.
template <typename Bytes, typename Statistics>
Bytes& StatisticsHead(Bytes& bytes, Statistics& all) {
  bytes.Number(all.messages).Number(all.schemas).Number(all.channels).Number(all.attachments);
  return bytes.Number(all.metadata).Number(all.chunks).Number(all.start).Number(all.end);
}

}  // namespace runnel
